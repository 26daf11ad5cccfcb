// The two views of the chart, fit and signals: the panels of each, and the curves in them. What is
// said of a curve here decides how it is drawn, fitted to its panel, marked and read at the cursor.

import { rangeOf } from "./drawing.js";
import { short } from "./ticks.js";

const LATE = 1.5; // [median time steps] in a longer one, a sample is missing
const LEAST_STEPS = 2.5, MOST_STEPS = 10; // [median time steps] range of the upper end of their axis
const SEEN = 0.01; // [share of the slopes] that may lie outside the axis, at each end
const MOST_SORTED = 20000; // samples used for a quantile at most
const NOISES = 6; // [standard deviations of the noise] least range of the residual

const ofLength = ({ symbol }) => symbol, ofSpeed = ({ symbol }) => `${symbol}/s`, ofVoltage = () => "V";
const velocity = { title: ({ symbol }) => `velocity, ${symbol}/s` };
const voltage = { title: () => "voltage, V" };

// The samples of a curve in run k, {first, values}: as recorded, simulated, or derived.
const recorded = (name) => ({ runs }, k) => ({ first: 0, values: runs[k][name] });
const computed = (model, name) => (chart, k) => chart[model][k] && { first: chart[model][k].first, values: chart[model][k][name] };
const derived = (name, first) => (chart, k) => ({ first, values: chart.derived.runs[k][name] });

export const VIEWS = {
  fit: {
    panels: {
      velocity: { ...velocity, share: 0.58, apart: 38 },
      error: { title: ({ symbol }) => `measured − simulated, ${symbol}/s`, share: 0.17, range: errorRange, moves: true },
      voltage: { ...voltage, share: 0.25 },
    },
    curves: [
      { panel: "voltage", label: "voltage", unit: ofVoltage, of: recorded("voltage"), color: "volts", width: 1.5, steps: true },
      { panel: "velocity", label: "measured", unit: ofSpeed, of: recorded("velocity"), color: "measured", width: 5, alpha: 0.42, dots: true },
      { panel: "velocity", of: computed("without", "velocity"), color: "quiet", width: 1.8, moves: true },
      { panel: "error", of: computed("without", "error"), color: "quiet", width: 1.2, moves: true },
      { panel: "velocity", label: "simulated", unit: ofSpeed, of: computed("simulated", "velocity"), color: "simulated", width: 1.8, moves: true },
      { panel: "error", label: "error", unit: ofSpeed, of: computed("simulated", "error"), color: "simulated", width: 1.2, alpha: 0.9, moves: true },
      { label: "position", unit: ofLength, of: recorded("position") },
    ],
  },
  signals: {
    panels: {
      voltage: { ...voltage, share: 0.2 },
      velocity: { ...velocity, share: 0.36 },
      position: { title: ({ symbol }) => `position, ${symbol}`, share: 0.24 },
      step: { title: ({ derived }) => `time step, ms; dashed: 1.5 × the median, ${short(Number(derived.late.toPrecision(3)))} ms`, share: 0.2, range: stepRange, dashed: ({ derived }) => derived.late },
    },
    curves: [
      { panel: "voltage", label: "voltage", unit: ofVoltage, of: recorded("voltage"), color: "volts", width: 1.5, steps: true, dots: true },
      { panel: "velocity", label: "slope of position", unit: ofSpeed, of: derived("slope", 0), fitted: derived("bounded", 0), color: "position", width: 1, alpha: 0.55 },
      { panel: "velocity", label: "velocity", unit: ofSpeed, of: recorded("velocity"), color: "measured", width: 2.5, alpha: 0.9, dots: true },
      { panel: "position", label: "position", unit: ofLength, of: recorded("position"), color: "position", width: 1.7, dots: true },
      { panel: "step", label: "time step", unit: () => "ms", of: derived("step", 1), color: "ink", width: 1, alpha: 0.8, dots: true, steps: true },
    ],
  },
};

const { panels, curves } = VIEWS.signals;
VIEWS.entry = { // the signals, and one more entry of the log
  panels: {
    ...Object.fromEntries(Object.entries(panels).map(([name, one]) => [name, { ...one, share: 0.8 * one.share }])),
    entry: { title: ({ entry }) => entry, share: 0.2 },
  },
  curves: [...curves, { panel: "entry", label: "value", unit: () => "", of: recorded("entry"), color: "ink", width: 1.3, dots: true, steps: true }],
};

/** The range of the residual, in round steps so that it does not flicker. */
function errorRange({ noise, ranges }, inView) {
  const [low, high] = rangeOf(inView);
  const most = Math.min(Math.max(NOISES * (noise ?? 0), -low, high), ranges.velocity[1] - ranges.velocity[0]) || 1;
  const power = 10 ** Math.floor(Math.log10(most));
  const round = [1, 1.5, 2, 3, 5, 7, 10].map((one) => one * power).find((one) => one >= most);
  return [-round, round];
}

/** The range of the time steps: from zero, and to so many medians. */
function stepRange({ derived: { median, longest } }) {
  return [0, median * Math.min(Math.max(LEAST_STEPS, (1.1 * longest) / median), MOST_STEPS)];
}

/** For each run, the time step before each sample [ms] and the slope of the position; for all runs,
 * the median and the longest time step, and the limit above which one is too long [ms]. */
export function deriveSignals(all) {
  const runs = all.map(({ time, position }) => {
    const last = time.length - 1;
    const step = time.map((value, k) => (k ? 1000 * (value - time[k - 1]) : NaN)).subarray(1);
    const slope = position.map((_, k) => {
      const [from, to] = [Math.max(k - 1, 0), Math.min(k + 1, last)];
      return to > from ? (position[to] - position[from]) / (time[to] - time[from]) : 0;
    });
    return { step, slope };
  });
  const [steps, slopes] = ["step", "slope"].map((name) => runs.map((one) => one[name]));
  const [low, high] = [quantile(slopes, SEEN), quantile(slopes, 1 - SEEN)];
  for (const one of runs) one.bounded = one.slope.map((value) => Math.min(Math.max(value, low), high));
  const median = quantile(steps, 0.5);
  return { runs, median, longest: rangeOf(steps)[1], late: LATE * median };
}

/** The value below which a share of all values lies. */
function quantile(arrays, share) {
  const count = arrays.reduce((sum, one) => sum + one.length, 0);
  const stride = Math.max(1, Math.floor(count / MOST_SORTED));
  const some = arrays.flatMap((one) => Array.from(one).filter((_, k) => k % stride === 0));
  some.sort((a, b) => a - b);
  return some.length ? some[Math.min(Math.floor(share * some.length), some.length - 1)] : 1;
}
