// Parts of every view of the chart: runs, faults, grids, times, overview, marked spans, cursor.

import { draw, drawLine, fillBox } from "./drawing.js";
import { roundTicks, short } from "./ticks.js";

const WHOLE = 0.6; // [share of the visible part of a run] a longer fault is marked above the run alone
const CLOSE = 12; // [px] numbers of a scale that are nearer overlap
const APART = 22; // [px] least distance of two lines of a grid
export const TOP = 44, AXIS = 24; // [px] height above the panels, and of the times below them

/** The name of a run for people: its part, its kind and the way it goes. */
export function nameOfRun({ part, test }, letters) {
  return `${part ? `${part} ` : ""}${test.replace(/-\w+$/, "").slice(0, letters)}${letters ? "." : ""} ${arrowOf(test)}`;
}

const arrowOf = (test) => (test.endsWith("forward") ? "→" : "←");

/** Draw a stripe and a name for each run. */
export function drawRuns(chart, to) {
  const { stripe, ink, quiet } = chart.colors;
  chart.clip(to, () => {
    for (const [k, run] of chart.runs.entries()) {
      const [from, end] = chart.timeline.spanOf(k).map((place) => chart.xOf(place));
      if (end < chart.left || from > chart.right) continue;
      draw(to, { color: stripe, fill: true }, () => to.roundRect(from - 3, TOP - 22, Math.max(end - from + 6, 3), chart.bottom - TOP + 26, 6));
      const begins = Math.max(from, chart.left) + 2;
      const room = Math.min(end, chart.right) - begins;
      const name = [nameOfRun(run), nameOfRun({ test: run.test }, 4), arrowOf(run.test)].find((one) => to.measureText(one).width <= room);
      to.textBaseline = "alphabetic";
      to.fillStyle = k === chart.cursor?.run ? ink : quiet;
      if (name) to.fillText(name, begins, TOP - 30);
    }
  });
}

export function drawFaults(chart, to) {
  let free = chart.right; // where the label to the right begins
  to.textBaseline = "alphabetic";
  chart.clip(to, () => {
    for (const one of chart.faults.toReversed()) {
      const from = chart.xOf(chart.timeline.placeOf(one.run, one.start));
      const end = Math.max(chart.xOf(chart.timeline.placeOf(one.run, one.end)), from + 2);
      const run = chart.timeline.spanOf(one.run).map((place) => chart.xOf(place));
      const within = ([first, last]) => Math.min(last, chart.right) - Math.max(first, chart.left);
      const color = chart.colors[one.color];
      if (one.color === "quiet" || within([from, end]) < WHOLE * within(run)) fillBox(to, color, 0.14, from, TOP - 22, end - from, chart.bottom - TOP + 26);
      fillBox(to, color, 1, from, TOP - 22, end - from, 3);
      if (!one.number || from > chart.right || end < chart.left) continue;
      const at = Math.max(from, chart.left);
      const text = [`${one.number} ${one.fault.replaceAll("-", " ")}`, one.number].find((words) => at + to.measureText(words).width < free);
      if (!text) continue;
      to.fillText(text, at + 1, TOP - 7);
      free = at - 6;
    }
  });
}

export function drawGrid(chart, to, name) {
  const { rule, quiet } = chart.colors;
  const { title, apart = APART, dashed } = chart.shown.panels[name];
  const y = chart.heights(name);
  const [low, high] = chart.ranges[name];
  const { top, bottom } = chart.panels[name];
  const across = (style, value) => drawLine(to, style, chart.left, Math.round(y(value)) + 0.5, chart.right, Math.round(y(value)) + 0.5);
  to.textBaseline = "middle";
  to.textAlign = "right";
  let [count, free] = [Math.max(2, Math.floor((bottom - top) / apart)), Infinity]; // free: where the next number may stand, above the one before
  while (roundTicks(low, high, count).length < 2) count++; // zero alone is no scale
  for (const tick of roundTicks(low, high, count)) {
    across({ color: rule, width: Math.abs(tick) < 1e-9 * (high - low) ? 1.6 : 0.8 }, tick);
    to.fillStyle = quiet;
    if (y(tick) > free) continue;
    free = y(tick) - CLOSE;
    to.fillText(short(tick), chart.left - 7, Math.round(y(tick)) + 0.5);
  }
  if (dashed) across({ color: quiet, dash: [5, 4] }, dashed(chart));
  to.textAlign = "left";
  to.textBaseline = "alphabetic";
  const at = [title(chart), chart.left + 5, name === Object.keys(chart.panels)[0] ? top + 13 : top - 6];
  draw(to, { color: chart.colors.card, width: 4 }, () => to.strokeText(...at)); // a curve below it stays behind
  to.fillStyle = quiet;
  to.fillText(...at);
}

/** Draw runs of other logs over the velocity. */
export function drawOthers(chart, to) {
  const y = chart.heights("velocity");
  for (const { color, run, time, velocity } of chart.others) {
    const stride = Math.max(1, Math.floor(time.length / 4000));
    const [begins, end] = chart.timeline.spanOf(run); // a longer run of another log is cut off
    draw(to, { color, width: 1.8 }, () => {
      for (let k = 0; k < time.length && begins + time[k] - time[0] <= end; k += stride) {
        to.lineTo(chart.xOf(begins + time[k] - time[0]), y(velocity[k]));
      }
    });
  }
}

/** Draw the band in which the residual is noise. */
export function drawNoise(chart, to) {
  const y = chart.heights("error");
  const high = y(2 * chart.noise);
  fillBox(to, chart.colors.band, 1, chart.left, high, chart.right - chart.left, y(-2 * chart.noise) - high);
}

/** Draw times below the runs: those of the log, or in the view of the signals since each test began. */
export function drawTimes(chart, to) {
  const { quiet, rule } = chart.colors;
  to.textAlign = "center";
  const apart = (70 / (chart.right - chart.left)) * (chart.view[1] - chart.view[0]);
  let free = chart.left - 16; // the first label may stand below the scale
  for (const [k, run] of chart.runs.entries()) {
    if (!run.time.length) continue;
    const begins = chart.showsSignals ? run.time[0] : 0;
    const [from, end] = [run.time[0] - begins, run.time[run.time.length - 1] - begins];
    for (const tick of roundTicks(from, end, Math.max((end - from) / apart, 1))) {
      const x = chart.xOf(chart.timeline.placeOf(k, begins + tick));
      const text = `${short(tick)} s`;
      const half = to.measureText(text).width / 2;
      if (x - half < free || x + half > chart.right + 6) continue;
      drawLine(to, { color: rule }, x, chart.bottom + 3, x, chart.bottom + 6);
      to.fillStyle = quiet;
      to.fillText(text, x, chart.bottom + 17);
      free = x + half + 10;
    }
  }
  to.textAlign = "left";
}

/** Draw an overview of the whole log, and which part of it is visible. */
export function drawOverview(chart, to) {
  const { top, bottom } = chart.overview;
  const { measured, simulated, rule, stripe } = chart.colors;
  const x = (place) => chart.left + (place / chart.timeline.end) * (chart.right - chart.left);
  const [low, high] = chart.wholeRange;
  const y = (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
  for (const [k, run] of chart.runs.entries()) {
    const [from, end] = chart.timeline.spanOf(k).map(x);
    const stride = Math.max(1, Math.floor(run.time.length / 400));
    fillBox(to, stripe, 0.85, from, top, Math.max(end - from, 1), bottom - top);
    draw(to, { color: measured, width: 1.2, alpha: 0.85 }, () => {
      for (let i = 0; i < run.time.length; i += stride) to.lineTo(x(chart.timeline.placeOf(k, run.time[i])), y(run.velocity[i]));
    });
  }
  for (const one of chart.faults) {
    const from = x(chart.timeline.placeOf(one.run, one.start));
    fillBox(to, chart.colors[one.color], 1, from, top, Math.max(x(chart.timeline.placeOf(one.run, one.end)) - from, 2), 3);
  }
  const [from, end] = chart.view.map((place) => Math.min(Math.max(x(place), chart.left), chart.right));
  draw(to, { color: rule }, () => to.rect(chart.left + 0.5, top + 0.5, chart.right - chart.left - 1, bottom - top - 1));
  if (end - from >= chart.right - chart.left - 2) return;
  fillBox(to, simulated, 0.12, from, top, end - from, bottom - top);
  draw(to, { color: simulated, width: 1.5 }, () => to.rect(from + 0.5, top + 0.5, end - from - 1, bottom - top - 1));
}

/** Draw the spans that the user marked, each with two edges to drag. */
export function drawSpans(chart, to) {
  const { mark } = chart.colors;
  const [top, high] = [TOP - 22, chart.bottom - TOP + 26];
  for (const [run, span] of chart.spans) {
    const [from, end] = span.map((sample) => chart.xOf(chart.timeline.placeOf(run, chart.runs[run].time[sample])));
    fillBox(to, mark, 0.2, from, top, Math.max(end - from, 1), high);
    for (const x of [from, end]) {
      draw(to, { color: mark, fill: true }, () => { to.rect(x - 0.75, top, 1.5, high); to.roundRect(x - 3, TOP + 2, 6, 22, 3); });
    }
  }
}

/** Draw a line at the cursor, and a dot on each curve. */
export function drawCursor(chart, to) {
  const { run, sample } = chart.cursor;
  const x = chart.xOf(chart.timeline.placeOf(run, chart.runs[run].time[sample]));
  if (x < chart.left - 1 || x > chart.right + 1) return;
  const { ink, card } = chart.colors;
  drawLine(to, { color: ink, alpha: 0.55 }, Math.round(x) + 0.5, TOP - 22, Math.round(x) + 0.5, chart.bottom + 4);
  for (const { panel, label, of, color } of chart.shown.curves) {
    const one = panel && label && of(chart, run);
    const value = one && one.values[sample - one.first];
    if (!Number.isFinite(value)) continue;
    const { top, bottom } = chart.panels[panel];
    const dot = () => to.arc(x, Math.min(Math.max(chart.heights(panel)(value), top), bottom), 4, 0, 7);
    draw(to, { color: chart.colors[color], fill: true }, dot);
    draw(to, { color: card, width: 1.5 }, dot);
  }
}
