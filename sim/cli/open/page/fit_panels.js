// The view of a fit: measured and simulated velocity, the residual, and the voltage.

import { drawGrid } from "./frame.js";

export const FIT_PANELS = [
  { name: "velocity", share: 0.58 },
  { name: "error", share: 0.17 },
  { name: "voltage", share: 0.25 },
];

/** The curves to which the panels are fitted: {panel, run, first, values}. */
export function fitCurves({ runs, simulated, without }) {
  const measured = runs.flatMap(({ velocity, voltage }, run) => [
    { panel: "velocity", run, first: 0, values: velocity }, { panel: "voltage", run, first: 0, values: voltage },
  ]);
  const computed = [simulated, without].flatMap((all) => all.map((one, run) => one && { panel: "velocity", run, first: one.first, values: one.velocity }));
  return [...measured, ...computed.filter(Boolean)];
}

/** Draw the curves that depend on the gains: simulated velocity and residual. */
export function drawFit(chart, to) {
  drawGrid(chart, to, "error");
  const [y, height] = [chart.heights("velocity"), chart.heights("error")];
  chart.clip(to, () => {
    if (chart.noise) {
      to.fillStyle = chart.colors.band;
      to.fillRect(chart.left, height(2 * chart.noise), chart.right - chart.left, height(-2 * chart.noise) - height(2 * chart.noise));
    }
    const { quiet, simulated } = chart.colors;
    const curves = [...chart.without.entries()].map(([k, one]) => [k, one, quiet]);
    for (const [k, one, color] of [...curves, ...[...chart.simulated.entries()].map(([k, one]) => [k, one, simulated])]) {
      if (!one) continue;
      const left = one.velocity.map((value, i) => chart.runs[k].velocity[one.first + i] - value);
      chart.curve(to, k, one.first, left, height, { color, width: 1.2, alpha: 0.9 });
      chart.clip(to, () => chart.curve(to, k, one.first, one.velocity, y, { color, width: 1.8 }), "velocity");
    }
  });
}

/** Limit of the residual's axis, in round steps so that it does not flicker. */
export function errorRange(chart) {
  let most = 6 * (chart.noise ?? 0);
  for (const [k, one] of [...chart.simulated.entries(), ...chart.without.entries()]) {
    if (!one) continue;
    const { velocity } = chart.runs[k];
    const [from, end] = chart.samplesInView(k, one.first, one.velocity.length);
    for (let i = from; i < end; i++) {
      const left = Math.abs(velocity[i] - one.velocity[i - one.first]);
      if (left > most) most = left;
    }
  }
  most = Math.min(most, chart.ranges.velocity[1] - chart.ranges.velocity[0]) || 1;
  const power = 10 ** Math.floor(Math.log10(most));
  const round = [1, 1.5, 2, 3, 5, 7, 10].map((one) => one * power).find((one) => one >= most);
  return [-round, round];
}

export function drawMeasured(chart, to, run) {
  const { measured, volts } = chart.colors;
  const { velocity, voltage } = chart.runs[run];
  const y = chart.heights("velocity");
  chart.curve(to, run, 0, velocity, y, { color: measured, width: 5, alpha: 0.42, dots: true });
  chart.curve(to, run, 0, voltage, chart.heights("voltage"), { color: volts, width: 1.5, steps: true });
}

export function drawOther(chart, to, { color, run, time, velocity }) {
  const y = chart.heights("velocity");
  to.strokeStyle = color;
  to.lineWidth = 1.3;
  to.globalAlpha = 0.75;
  to.beginPath();
  const stride = Math.max(1, Math.floor(time.length / 4000));
  const [begins, end] = chart.timeline.spanOf(run); // a longer run of another log is cut off
  for (let k = 0; k < time.length && begins + time[k] - time[0] <= end; k += stride) {
    to.lineTo(chart.xOf(begins + time[k] - time[0]), y(velocity[k]));
  }
  to.stroke();
  to.globalAlpha = 1;
}

/** Height and color of each value at the cursor. */
export function fitMarks(chart, { run, sample }) {
  const [y, height] = [chart.heights("velocity"), chart.heights("error")];
  const { velocity, voltage } = chart.runs[run];
  const { measured, simulated, volts } = chart.colors;
  const one = chart.simulated[run];
  const guess = one && sample >= one.first ? one.velocity[sample - one.first] : null;
  const marks = [[y(velocity[sample]), measured], [chart.heights("voltage")(voltage[sample]), volts]];
  if (guess !== null) marks.push([y(guess), simulated], [height(velocity[sample] - guess), simulated]);
  return marks;
}
