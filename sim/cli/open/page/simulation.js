// The simulated velocity of a log, with gains that the user moves.

import { makeModel, rms, simulateRun } from "./simulate.js";

/** Simulate every run of a log with gains in its unit; returns the error, sets curves in `log`. */
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
    const error = rms(run.velocity.subarray(start.first), velocity);
    sum += error * error * velocity.length;
    count += velocity.length;
    return { first: start.first, velocity };
  });
  return count ? Math.sqrt(sum / count) : null;
}
