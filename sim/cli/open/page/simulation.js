// The simulated velocity of a log, with gains that the user moves.

import { makeModel, simulateRun } from "./simulate.js";

/** Simulate every run of a log with gains in its unit; returns the error
 * and sets curves in `log`. What was left out is not simulated: its samples are NaN. */
export function simulate(log, gains) {
  const { si } = log.summary.units;
  const { tracks } = log.fit; // of a model with effects, which only the server simulates
  const inSi = { ...gains, kV: gains.kV / si, kA: gains.kA / si };
  const model = makeModel(log.fit.type, inSi, log.fit);
  let [sum, count] = [0, 0];
  log.simulated = log.runs.map((run, k) => {
    const pieces = log.fit.starts[k];
    if (!pieces?.length || !(tracks ? tracks[k] : model)) return null;
    const { first } = pieces[0];
    const velocity = new Float64Array(run.time.length - first).fill(NaN);
    for (const start of pieces) {
      const [from, end] = [start.first, start.first + start.count];
      const cut = { time: run.time.subarray(from, end), voltage: run.voltage.subarray(from, end) };
      const values = tracks ? tracks[k].slice(from, end) : simulateRun(cut, model, start).velocity;
      values.forEach((value, i) => { velocity[from - first + i] = value / si; });
      for (let i = from; i < end; i++) sum += (run.velocity[i] - velocity[i - first]) ** 2;
      count += start.count;
    }
    return { first, velocity };
  });
  return count ? Math.sqrt(sum / count) : null;
}
