// The signals of a log without a fit: voltage, velocity, position and time steps, all runs on the
// same axes. The slope of the position is drawn over the velocity, so that both can be compared.

import { line, rangeOf, short } from "./drawing.js";

export const SIGNAL_PANELS = [
  { name: "voltage", share: 0.2 },
  { name: "velocity", share: 0.36 },
  { name: "position", share: 0.24 },
  { name: "step", share: 0.2 },
];
const LATE = 1.5; // [median time steps] in a longer one, a sample is missing
const LEAST_STEPS = 2.5, MOST_STEPS = 10; // [median time steps] range of the upper end of their axis
const SEEN = 0.01; // [share of the slopes] that may lie outside the axis, at each end
const MOST_SORTED = 20000; // samples used for a quantile at most

/** The title of the panel of time steps, which explains the dashed line. */
export function stepTitle({ derived }) {
  return `time step, ms; dashed: 1.5 × the median, ${short(Number(derived.late.toPrecision(3)))} ms`;
}

/** For each run, the time step before each sample [ms] and the slope of the position; for all runs,
 * the median and the longest time step, and the limit above which one is too long [ms]. */
export function deriveSignals(runs) {
  const runsWith = runs.map(({ time, position }) => {
    const last = time.length - 1;
    const step = time.map((value, k) => (k ? 1000 * (value - time[k - 1]) : NaN)).subarray(1);
    const slope = position.map((_, k) => {
      const [from, to] = [Math.max(k - 1, 0), Math.min(k + 1, last)];
      return to > from ? (position[to] - position[from]) / (time[to] - time[from]) : 0;
    });
    return { step, slope };
  });
  const median = share(runsWith.map(({ step }) => step), 0.5);
  const slopes = runsWith.map(({ slope }) => slope);
  const [low, high] = [share(slopes, SEEN), share(slopes, 1 - SEEN)];
  for (const one of runsWith) one.bounded = one.slope.map((value) => Math.min(Math.max(value, low), high));
  const longest = rangeOf(runsWith.map(({ step }) => step))[1];
  return { runs: runsWith, median, longest, late: LATE * median };
}

/** The curves to which the panels are fitted; of the slopes, without the few that stick out. */
export function signalCurves({ runs, derived }) {
  return runs.flatMap(({ voltage, velocity, position }, run) => [
    ["voltage", voltage], ["velocity", velocity], ["velocity", derived.runs[run].bounded], ["position", position],
  ].map(([panel, values]) => ({ panel, run, first: 0, values })));
}

/** The range of the time steps: from zero, and to so many medians. */
export function stepRange({ derived: { median, longest } }) {
  return [0, median * Math.min(Math.max(LEAST_STEPS, (1.1 * longest) / median), MOST_STEPS)];
}

/** Draw all signals of a chart. */
export function drawSignals(chart, to) {
  const { measured, volts, position: place, ink } = chart.colors;
  const curves = [
    ["voltage", (run) => run.voltage, 0, { color: volts, width: 1.5, steps: true, dots: true }],
    ["velocity", (run) => run.velocity, 0, { color: measured, width: 4, alpha: 0.5, dots: true }],
    ["velocity", (_, k) => chart.derived.runs[k].slope, 0, { color: place, width: 1.3 }],
    ["position", (run) => run.position, 0, { color: place, width: 1.7, dots: true }],
    ["step", (_, k) => chart.derived.runs[k].step, 1, { color: ink, width: 1, alpha: 0.8, dots: true, steps: true }],
  ];
  for (const [name, valuesOf, first, style] of curves) {
    const y = chart.heights(name);
    chart.clip(to, () => {
      for (const [k, run] of chart.runs.entries()) chart.curve(to, k, first, valuesOf(run, k), y, style);
    }, name);
  }
  drawLate(chart, to);
}

/** Draw the limit above which a time step is too long. */
function drawLate(chart, to) {
  const y = Math.round(chart.heights("step")(chart.derived.late)) + 0.5;
  to.strokeStyle = chart.colors.quiet;
  to.lineWidth = 1;
  to.setLineDash([5, 4]);
  line(to, chart.left, y, chart.right, y);
  to.setLineDash([]);
}

/** Height and color of each signal at a cursor. */
export function signalMarks(chart, { run, sample }) {
  const { measured, volts, position, ink } = chart.colors;
  const { velocity, voltage, position: places } = chart.runs[run];
  const { slope, step } = chart.derived.runs[run];
  const marks = [
    [chart.heights("voltage")(voltage[sample]), volts],
    [chart.heights("velocity")(slope[sample]), position],
    [chart.heights("velocity")(velocity[sample]), measured],
    [chart.heights("position")(places[sample]), position],
  ];
  const [, most] = chart.rangeOfPanel("step");
  if (sample > 0) marks.push([chart.heights("step")(Math.min(step[sample - 1], most)), ink]);
  return marks;
}

/** A quantile: the value below which a share of all values lies. */
function share(arrays, part) {
  const count = arrays.reduce((sum, one) => sum + one.length, 0);
  const stride = Math.max(1, Math.floor(count / MOST_SORTED));
  const some = arrays.flatMap((one) => Array.from(one).filter((_, k) => k % stride === 0));
  some.sort((a, b) => a - b);
  return some.length ? some[Math.min(Math.floor(part * some.length), some.length - 1)] : 1;
}
