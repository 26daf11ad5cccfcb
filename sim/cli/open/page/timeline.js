// The time axis: the runs of a log one after another, without the time between them.

const GAP = 0.018; // [share of the length of all runs] gap between two runs

/** The positions of the runs on the axis, in seconds since the start of the first run. */
export class Timeline {
  constructor(runs) {
    const total = runs.reduce((sum, run) => sum + lasts(run), 0) || 1;
    const gap = GAP * total;
    let at = 0;
    this.runs = runs;
    this.offsets = runs.map((run) => {
      const begins = at;
      at += lasts(run) + gap;
      return begins;
    });
    this.end = Math.max(at - gap, 1e-3);
  }

  /** The position on the axis of a time in a run. */
  placeOf(run, time) {
    return this.offsets[run] + time - this.runs[run].time[0];
  }

  /** The run and the sample nearest to a position on the axis. */
  sampleAt(place) {
    let run = 0;
    while (run + 1 < this.runs.length && middleOfGap(this, run) < place) run++;
    return { run, sample: this.sampleIn(run, place) };
  }

  /** The sample of a run nearest to a position on the axis. */
  sampleIn(run, place) {
    const { time } = this.runs[run];
    const when = place - this.offsets[run] + time[0];
    const after = Math.min(firstNotBefore(time, when), time.length - 1);
    const before = Math.max(after - 1, 0);
    return when - time[before] < time[after] - when ? before : after;
  }

  /** The first and last position of a run on the axis. */
  spanOf(run) {
    return [this.offsets[run], this.offsets[run] + lasts(this.runs[run])];
  }
}

/** The first index in a rising array whose value is not below another. */
export function firstNotBefore(values, value) {
  let [low, high] = [0, values.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

function lasts(run) {
  return run.time.length ? run.time[run.time.length - 1] - run.time[0] : 0;
}

function middleOfGap(timeline, run) {
  return 0.5 * (timeline.spanOf(run)[1] + timeline.offsets[run + 1]);
}
