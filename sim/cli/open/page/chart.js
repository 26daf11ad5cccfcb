// The chart: measured and simulated velocity, the residual, and the voltage; or the signals of the
// log alone, in which spans can be marked (curves.js).
//
// There are two canvases. The lower one holds what does not depend on the gains; the upper one holds
// the simulated curve and the cursor, and is drawn once per frame.

import { VIEWS, deriveSignals } from "./curves.js";
import { draw, rangeOf, widen } from "./drawing.js";
import { AXIS, TOP, drawCursor, drawFaults, drawGrid, drawNoise, drawOthers, drawOverview, drawRuns, drawSpans, drawTimes } from "./frame.js";
import { listen } from "./hands.js";
import { Timeline, firstNotBefore } from "./timeline.js";

const GAP = 26, OVERVIEW = 34; // [px]
const CLOSEST = 0.08; // [s] shortest visible interval
const DOTS = 5; // [px] distance of samples from which each is drawn as a dot

export class Chart {
  constructor(still, moving, { onCursor, onSpans }) {
    this.still = still;
    this.moving = moving;
    this.onCursor = onCursor;
    this.onSpans = onSpans;
    this.showsSignals = false;
    this.dragMarks = true; // whether dragging marks a span in the view of the signals; Shift inverts it
    this.spans = new Map();
    this.pictures = 0;
    this.runs = [];
    this.faults = [];
    this.others = [];
    this.ranges = {};
    this.simulated = this.without = [];
    this.noise = null;
    this.cursor = null;
    new ResizeObserver(() => this.resize()).observe(still.parentElement);
    listen(this);
  }

  /** Show a log: its runs, with samples in the log's own unit. */
  setLog({ runs, faults, symbol, entry }) {
    this.entry = entry; // name of one more entry in the view of the signals
    this.runs = runs;
    this.faults = faults;
    this.symbol = symbol;
    this.simulated = this.without = [];
    this.noise = null;
    this.cursor = null;
    this.timeline = new Timeline(runs);
    this.wholeRange = widen(rangeOf(runs.map((run) => run.velocity)));
    this.spans = new Map();
    this.signals = null;
    this.showAll();
  }

  /** Show the signals of the log alone, or the measured signals with the simulated ones. */
  showSignals(on) {
    this.showsSignals = on;
    this.resize();
  }

  /** Time steps and slopes, computed when they are needed. */
  get derived() {
    return (this.signals ??= deriveSignals(this.runs));
  }

  /** The panels and curves of the view. */
  get shown() {
    return VIEWS[!this.showsSignals ? "fit" : this.entry ? "entry" : "signals"];
  }

  /** Fit a panel to what is visible of its curves. */
  fitHeight(name) {
    const { range } = this.shown.panels[name];
    const inView = this.shown.curves.filter(({ panel }) => panel === name).flatMap(({ of, fitted = of }) => this.runs.map((_, k) => {
      const one = fitted(this, k);
      if (!one) return [];
      const [from, end] = this.samplesInView(k, one.first, one.values.length);
      return one.values.subarray(from - one.first, end - one.first);
    }));
    this.ranges[name] = range ? range(this, inView) : widen(rangeOf(inView));
  }

  /** The first sample of a run that is visible, and the one after the last, of a curve's samples. */
  samplesInView(run, first, count) {
    const { time } = this.runs[run];
    const begins = this.timeline.offsets[run] - time[0];
    const [left, right] = this.timeline.spanOf(run);
    if (left > this.view[1] || right < this.view[0]) return [first, first];
    const from = Math.max(firstNotBefore(time, this.view[0] - begins) - 1, first);
    return [from, Math.max(from, Math.min(firstNotBefore(time, this.view[1] - begins) + 1, first + count))];
  }

  /** Mark a span of a run, from one sample to another; null removes it. */
  setSpan(run, span) {
    if (span) this.spans.set(run, span);
    else this.spans.delete(run);
    this.onSpans(this.spans);
    this.requestMoving();
  }

  /** Mark faults, {run, start, end, name}, or lay runs of other logs over: {color, run, time, velocity}. */
  mark(what) {
    Object.assign(this, what);
    this.redraw();
  }

  /** Set the simulated curves, {first, velocity} or null for each run, and draw them at once.
   *
   * A model with effects is drawn over the one without them.
   */
  setSimulation(simulated, noise, without = []) {
    const addError = (one, k) => one && { ...one, error: one.velocity.map((value, i) => this.runs[k].velocity[one.first + i] - value) };
    this.simulated = simulated.map(addError);
    this.without = without.map(addError);
    this.noise = noise;
    if (!this.showsSignals) this.fitHeight("error");
    this.requestMoving();
  }

  /** Zoom to an interval of the axis, with a margin on both sides. */
  show(from, to, room = 0.04) {
    const extra = room * Math.max(to - from, CLOSEST);
    this.setView(from - extra, to + extra);
  }

  showAll() {
    if (this.timeline) this.show(0, this.timeline.end, 0.012);
  }

  showRun(run) {
    this.show(...this.timeline.spanOf(run));
  }

  /** Zoom to a fault, with a second around it. */
  showFault({ run, start, end }) {
    const around = Math.max(0.6, 1.2 * (end - start));
    this.setView(
      this.timeline.placeOf(run, start) - around,
      this.timeline.placeOf(run, end) + around,
    );
    this.setCursor({ run, sample: firstNotBefore(this.runs[run].time, start) });
  }

  setView(from, to) {
    const whole = this.timeline.end;
    const room = 0.012 * whole;
    const width = Math.min(Math.max(to - from, CLOSEST), whole + 2 * room);
    const begins = Math.min(Math.max(0.5 * (from + to - width), -room), whole + room - width);
    this.view = [begins, begins + width];
    this.redraw();
  }

  setCursor(cursor) {
    this.cursor = cursor;
    this.onCursor(cursor);
    this.requestMoving();
  }

  redraw() {
    if (this.view) for (const name of Object.keys(this.shown.panels)) this.fitHeight(name);
    this.stillIsOld = true;
    this.requestMoving();
  }

  requestMoving() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      if (!this.runs.length || !this.width) return;
      if (this.stillIsOld) this.drawStill();
      this.stillIsOld = false;
      this.drawMoving();
      this.pictures++;
    });
  }

  /** Fit the canvases to their container, in device pixels. */
  resize() {
    const { clientWidth, clientHeight } = this.still.parentElement;
    const sharp = Math.min(devicePixelRatio || 1, 3);
    for (const canvas of [this.still, this.moving]) {
      canvas.width = Math.round(clientWidth * sharp);
      canvas.height = Math.round(clientHeight * sharp);
      canvas.getContext("2d").setTransform(sharp, 0, 0, sharp, 0, 0);
    }
    this.width = clientWidth;
    this.height = clientHeight;
    this.left = clientWidth < 560 ? 44 : 54;
    this.right = clientWidth - (clientWidth < 560 ? 8 : 14);
    let y = TOP;
    const room = clientHeight - TOP - AXIS - OVERVIEW - GAP * (Object.keys(this.shown.panels).length - 1) - 10;
    this.panels = {};
    for (const [name, { share }] of Object.entries(this.shown.panels)) {
      this.panels[name] = { top: y, bottom: y + share * room };
      y += share * room + GAP;
    }
    this.bottom = y - GAP;
    this.overview = { top: clientHeight - OVERVIEW, bottom: clientHeight - 4 };
    this.redraw();
  }

  /** Read the colors and the font of the theme again. */
  readColors() {
    const style = getComputedStyle(this.still);
    this.font = style.font;
    const names = ["ink", "quiet", "rule", "card", "measured", "simulated", "volts", "fault", "band", "stripe", "position", "mark"];
    this.colors = Object.fromEntries(names.map((one) => {
      this.still.style.color = `var(--${one})`;
      return [one, style.color];
    }));
    this.redraw();
  }

  xOf(place) {
    return this.left + ((place - this.view[0]) / (this.view[1] - this.view[0])) * (this.right - this.left);
  }

  placeOfX(x) {
    return this.view[0] + ((x - this.left) / (this.right - this.left)) * (this.view[1] - this.view[0]);
  }

  /** A function from a value to a height in a panel. */
  heights(name) {
    const { top, bottom } = this.panels[name];
    const [low, high] = this.ranges[name];
    return (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
  }

  // ---- static parts

  drawStill() {
    const to = this.still.getContext("2d");
    to.clearRect(0, 0, this.width, this.height);
    to.font = this.font;
    drawRuns(this, to);
    drawFaults(this, to);
    for (const [name, { moves }] of Object.entries(this.shown.panels)) if (!moves) drawGrid(this, to, name);
    this.drawCurves(to, false);
    this.clip(to, () => drawOthers(this, to), "velocity");
    drawTimes(this, to);
    drawOverview(this, to);
  }

  /** Clip drawing to the runs; with the name of a panel, to that panel. */
  clip(to, draw, name) {
    const { top, bottom } = this.panels[name] ?? { top: 8, bottom: this.overview.top - AXIS - 2 };
    to.save();
    to.beginPath();
    to.rect(this.left - 3, top - 8, this.right - this.left + 3, bottom - top + 14);
    to.clip();
    draw();
    to.restore();
  }

  /** Draw the curves that move with the gains, or the others. */
  drawCurves(to, moving) {
    for (const { panel, of, moves = false, ...style } of this.shown.curves) {
      if (!panel || moves !== moving) continue;
      const y = this.heights(panel);
      this.clip(to, () => {
        for (const run of this.runs.keys()) this.drawCurve(to, run, of(this, run), y, { ...style, color: this.colors[style.color] });
      }, panel);
    }
  }

  /** Draw one curve of a run; if samples are closer than pixels, from the lowest to the highest. */
  drawCurve(to, run, samples, y, style) {
    if (!samples) return;
    const { first, values } = samples;
    const { time } = this.runs[run];
    const begins = this.timeline.offsets[run] - time[0];
    const [from, end] = this.samplesInView(run, first, values.length);
    if (end - from < 1) return;
    const x = (k) => this.xOf(begins + time[k]);
    const apart = (x(end - 1) - x(from)) / Math.max(end - from - 1, 1);
    draw(to, style, () => {
      let last = NaN; // after what is not simulated, the line begins again
      for (let k = from; apart >= 0.5 && k < end; k++) {
        if (style.steps && k > from) to.lineTo(x(k), last);
        to[Number.isNaN(last) ? "moveTo" : "lineTo"](x(k), y(values[k - first]));
        last = y(values[k - first]);
      }
      for (let k = from; apart < 0.5 && k < end; ) {
        const column = Math.round(x(k));
        let [low, high] = [Infinity, -Infinity];
        for (; k < end && Math.round(x(k)) === column; k++) {
          low = Math.min(low, values[k - first]);
          high = Math.max(high, values[k - first]);
        }
        to[Number.isNaN(last) ? "moveTo" : "lineTo"](column, y(low));
        last = y(high);
        to.lineTo(column, last);
      }
    });
    for (let k = from; style.dots && apart >= DOTS && k < end; k++) {
      draw(to, { color: style.color, fill: true }, () => to.arc(x(k), y(values[k - first]), 2.4, 0, 7));
    }
  }

  drawMoving() {
    const to = this.moving.getContext("2d");
    to.clearRect(0, 0, this.width, this.height);
    to.font = this.font;
    if (this.showsSignals) this.clip(to, () => drawSpans(this, to));
    else {
      drawGrid(this, to, "error");
      if (this.noise) this.clip(to, () => drawNoise(this, to), "error");
    }
    this.drawCurves(to, true);
    if (this.cursor) drawCursor(this, to);
  }

  // ---- moving and zooming

  stepCursor(by) {
    let { run, sample } = this.cursor ?? this.timeline.sampleAt(this.view[0]);
    sample += by;
    if (sample < 0 && run > 0) sample = this.runs[--run].time.length - 1;
    if (sample >= this.runs[run].time.length && run + 1 < this.runs.length) [run, sample] = [run + 1, 0];
    sample = Math.min(Math.max(sample, 0), this.runs[run].time.length - 1);
    this.setCursor({ run, sample });
    const place = this.timeline.placeOf(run, this.runs[run].time[sample]);
    const [from, to] = this.view;
    if (place < from || place > to) this.setView(place - 0.5 * (to - from), place + 0.5 * (to - from));
    return true;
  }

  stepRun(by) {
    const now = this.timeline.sampleAt(0.5 * (this.view[0] + this.view[1])).run;
    const whole = this.view[1] - this.view[0] > 0.98 * this.timeline.end;
    const next = whole ? (by > 0 ? 0 : this.runs.length - 1) : now + by;
    const run = Math.min(Math.max(next, 0), this.runs.length - 1);
    this.showRun(run);
    this.setCursor({ run, sample: 0 });
    return true;
  }

  pan(pixels) {
    const by = (pixels / (this.right - this.left)) * (this.view[1] - this.view[0]);
    this.setView(this.view[0] + by, this.view[1] + by);
  }

  centerOn(x) {
    const place = ((x - this.left) / (this.right - this.left)) * this.timeline.end;
    const half = 0.5 * (this.view[1] - this.view[0]);
    this.setView(place - half, place + half);
  }

  zoomAt(x, factor) {
    const place = this.placeOfX(Math.min(Math.max(x, this.left), this.right));
    const [from, to] = this.view;
    this.setView(place - (place - from) * factor, place + (to - place) * factor);
  }
}
