// Parts of every view of the chart: runs, faults, grids, times, overview, marked spans, cursor.

import { line, short } from "./drawing.js";
import { stepTitle } from "./signals.js";
import { roundTicks } from "./timeline.js";

const WHOLE = 0.6; // [share of the visible part of a run] a longer fault is marked above the run alone
export const TOP = 44, AXIS = 24; // [px] height above the panels, and of the times below them
const TITLES = {
  velocity: ({ symbol }) => `velocity, ${symbol}/s`,
  error: ({ symbol }) => `measured − simulated, ${symbol}/s`,
  voltage: () => "voltage, V",
  position: ({ symbol }) => `position, ${symbol}`,
  step: stepTitle,
};

/** Draw a stripe and a name for each run. */
export function drawRuns(chart, to) {
  const { stripe, ink, quiet } = chart.colors;
  const { bottom } = chart;
  chart.clip(to, () => {
    for (const [k, run] of chart.runs.entries()) {
      const [from, end] = chart.timeline.spanOf(k).map((place) => chart.xOf(place));
      if (end < chart.left || from > chart.right) continue;
      to.fillStyle = stripe;
      to.beginPath();
      to.roundRect(from - 3, TOP - 22, Math.max(end - from + 6, 3), bottom - TOP + 26, 6);
      to.fill();
      const begins = Math.max(from, chart.left) + 2;
      const room = Math.min(end, chart.right) - begins;
      const [kind, way] = [run.test.replace(/-\w+$/, ""), run.test.endsWith("forward") ? "→" : "←"];
      to.textBaseline = "alphabetic";
      for (const text of [`${run.part ? `${run.part} ` : ""}${kind} ${way}`, `${kind.slice(0, 4)}. ${way}`, way]) {
        if (to.measureText(text).width > room) continue;
        to.fillStyle = k === chart.cursor?.run ? ink : quiet;
        to.fillText(text, begins, TOP - 30);
        break;
      }
    }
  });
}

export function drawFaults(chart, to) {
  const { fault } = chart.colors;
  let free = 0;
  to.textBaseline = "alphabetic";
  chart.clip(to, () => {
    for (const one of chart.faults) {
      const from = chart.xOf(chart.timeline.placeOf(one.run, one.start));
      const end = Math.max(chart.xOf(chart.timeline.placeOf(one.run, one.end)), from + 2);
      const run = chart.timeline.spanOf(one.run).map((place) => chart.xOf(place));
      const within = ([first, last]) => Math.min(last, chart.right) - Math.max(first, chart.left);
      to.fillStyle = fault;
      if (within([from, end]) < WHOLE * within(run)) {
        to.globalAlpha = 0.14;
        to.fillRect(from, TOP - 22, end - from, chart.bottom - TOP + 26);
        to.globalAlpha = 1;
      }
      to.fillRect(from, TOP - 22, end - from, 3);
      const width = to.measureText(one.name).width;
      const at = Math.max(Math.min(from, chart.right - width - 6), chart.left);
      if (from < chart.right && end > chart.left && at > free) {
        to.fillText(one.name, at + 1, TOP - 7);
        free = at + width + 8;
      }
    }
  });
}

export function drawGrid(chart, to, name) {
  const { rule, quiet } = chart.colors;
  const title = TITLES[name](chart);
  const y = chart.heights(name);
  const [low, high] = chart.rangeOfPanel(name);
  to.textBaseline = "middle";
  to.fillStyle = quiet;
  const { top, bottom } = chart.panels[name];
  const apart = name === "velocity" && !chart.showsSignals ? 38 : 22; // [px]
  const count = Math.max(2, Math.floor((bottom - top) / apart));
  for (const tick of roundTicks(low, high, count)) {
    const at = Math.round(y(tick)) + 0.5;
    to.strokeStyle = rule;
    to.lineWidth = Math.abs(tick) < 1e-9 * (high - low) ? 1.6 : 0.8;
    line(to, chart.left, at, chart.right, at);
    to.textAlign = "right";
    to.fillText(short(tick), chart.left - 7, at);
  }
  to.textAlign = "left";
  to.textBaseline = "alphabetic";
  to.fillText(title, chart.left + 5, name === chart.panelsShown[0].name ? top + 13 : top - 6);
}

/** Draw times below the runs: those of the log, or in the view of the signals since each test began. */
export function drawTimes(chart, to) {
  const { quiet, rule } = chart.colors;
  const at = chart.bottom + 17;
  to.fillStyle = quiet;
  to.textAlign = "center";
  const apart = (70 / (chart.right - chart.left)) * (chart.view[1] - chart.view[0]);
  let free = chart.left;
  for (const [k, run] of chart.runs.entries()) {
    if (!run.time.length) continue;
    const begins = chart.showsSignals ? run.time[0] : 0;
    const [from, end] = [run.time[0] - begins, run.time[run.time.length - 1] - begins];
    for (const tick of roundTicks(from, end, Math.max((end - from) / apart, 1))) {
      const x = chart.xOf(chart.timeline.placeOf(k, begins + tick));
      const text = `${short(tick)} s`;
      const half = to.measureText(text).width / 2;
      if (x - half < free || x + half > chart.right + 6) continue;
      to.fillText(text, x, at);
      to.strokeStyle = rule;
      line(to, x, chart.bottom + 3, x, chart.bottom + 6);
      free = x + half + 10;
    }
  }
  to.textAlign = "left";
}

/** Draw an overview of the whole log, and which part of it is visible. */
export function drawOverview(chart, to) {
  const { top, bottom } = chart.overview;
  const { measured, simulated, rule, fault, stripe } = chart.colors;
  const x = (place) => chart.left + (place / chart.timeline.end) * (chart.right - chart.left);
  const [low, high] = chart.wholeRange;
  const y = (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
  to.strokeStyle = measured;
  to.globalAlpha = 0.85;
  to.lineWidth = 1.2;
  for (const [k, run] of chart.runs.entries()) {
    const [from, end] = chart.timeline.spanOf(k).map(x);
    to.fillStyle = stripe;
    to.fillRect(from, top, Math.max(end - from, 1), bottom - top);
    const stride = Math.max(1, Math.floor(run.time.length / 400));
    to.beginPath();
    for (let i = 0; i < run.time.length; i += stride) {
      to.lineTo(x(chart.timeline.placeOf(k, run.time[i])), y(run.velocity[i]));
    }
    to.stroke();
  }
  to.globalAlpha = 1;
  to.fillStyle = fault;
  for (const one of chart.faults) {
    const from = x(chart.timeline.placeOf(one.run, one.start));
    to.fillRect(from, top, Math.max(x(chart.timeline.placeOf(one.run, one.end)) - from, 2), 3);
  }
  const seen = chart.view.map((place) => Math.min(Math.max(x(place), chart.left), chart.right));
  to.strokeStyle = rule;
  to.lineWidth = 1;
  to.strokeRect(chart.left + 0.5, top + 0.5, chart.right - chart.left - 1, bottom - top - 1);
  if (seen[1] - seen[0] < chart.right - chart.left - 2) {
    to.globalAlpha = 0.12;
    to.fillStyle = simulated;
    to.fillRect(seen[0], top, seen[1] - seen[0], bottom - top);
    to.globalAlpha = 1;
    to.strokeStyle = simulated;
    to.lineWidth = 1.5;
    to.strokeRect(seen[0] + 0.5, top + 0.5, seen[1] - seen[0] - 1, bottom - top - 1);
  }
}

/** Draw the spans that the user marked, each with two edges to drag. */
export function drawSpans(chart, to) {
  const { mark } = chart.colors;
  for (const [run, span] of chart.spans) {
    const [from, end] = span.map((sample) => chart.xOf(chart.timeline.placeOf(run, chart.runs[run].time[sample])));
    to.fillStyle = mark;
    to.globalAlpha = 0.2;
    to.fillRect(from, TOP - 22, Math.max(end - from, 1), chart.bottom - TOP + 26);
    to.globalAlpha = 1;
    for (const x of [from, end]) {
      to.fillRect(x - 0.75, TOP - 22, 1.5, chart.bottom - TOP + 26);
      to.beginPath();
      to.roundRect(x - 3, TOP + 2, 6, 22, 3);
      to.fill();
    }
  }
}

export function drawCursor(chart, to, marks) {
  const { run, sample } = chart.cursor;
  const x = chart.xOf(chart.timeline.placeOf(run, chart.runs[run].time[sample]));
  if (x < chart.left - 1 || x > chart.right + 1) return;
  const { ink, card } = chart.colors;
  to.strokeStyle = ink;
  to.globalAlpha = 0.55;
  to.lineWidth = 1;
  line(to, Math.round(x) + 0.5, TOP - 22, Math.round(x) + 0.5, chart.bottom + 4);
  to.globalAlpha = 1;
  for (const [at, color] of marks) {
    to.beginPath();
    to.arc(x, at, 4, 0, 7);
    to.fillStyle = color;
    to.fill();
    to.lineWidth = 1.5;
    to.strokeStyle = card;
    to.stroke();
  }
}
