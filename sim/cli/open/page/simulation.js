// The simulated velocity of a log, with gains that the user moves.

import { makeModel, simulateRun } from "./simulate.js";

/** Simulate every run of a log with gains in its unit; returns the error
 * without what was left out, sets curves in `log`. */
export function simulate(log, gains) {
  const { si } = log.summary.units;
  const { tracks } = log.fit; // of a model with effects, which only the server simulates
  const inSi = { ...gains, kV: gains.kV / si, kA: gains.kA / si };
  const model = makeModel(log.fit.type, inSi, log.fit);
  let [sum, count] = [0, 0];
  log.simulated = log.runs.map((run, k) => {
    const start = log.fit.starts[k];
    if (!start || !(tracks ? tracks[k] : model)) return null;
    const cut = { time: run.time.subarray(start.first), voltage: run.voltage.subarray(start.first) };
    const velocity = tracks ? Float64Array.from(tracks[k].slice(start.first)) : simulateRun(cut, model, start).velocity;
    if (si !== 1) velocity.forEach((value, i) => { velocity[i] = value / si; });
    const gone = log.leftOut.filter(({ test }) => test === run.test);
    velocity.forEach((value, i) => {
      if (gone.some((part) => cut.time[i] >= part.start && cut.time[i] <= part.end)) return;
      sum += (run.velocity[start.first + i] - value) ** 2;
      count++;
    });
    return { first: start.first, velocity };
  });
  return count ? Math.sqrt(sum / count) : null;
}
