// The chart: velocity measured and simulated, what is left between both, and the voltage; or the
// signals of the log alone (signals.js), in which spans can be marked.
//
// Two canvases lie on each other. The lower one holds what stands still while a gain is moved; the
// upper one the simulated curve and the cursor, drawn once a picture.

import { line, rangeOf, short } from "./drawing.js";
import { listen } from "./hands.js";
import { SIGNAL_PANELS, deriveSignals, drawSignals, signalMarks, signalRanges, stepTitle } from "./signals.js";
import { Timeline, firstNotBefore, roundTicks } from "./timeline.js";

const FIT_PANELS = [
  { name: "velocity", share: 0.58 },
  { name: "error", share: 0.17 },
  { name: "voltage", share: 0.25 },
];
const TITLES = {
  velocity: ({ symbol }) => `velocity, ${symbol}/s`,
  error: ({ symbol }) => `measured − simulated, ${symbol}/s`,
  voltage: () => "voltage, V",
  position: ({ symbol }) => `position, ${symbol}`,
  step: stepTitle,
};
const TOP = 44, GAP = 26, AXIS = 24, OVERVIEW = 34; // [px]
const CLOSEST = 0.08; // [s] a view is never shorter
const DOTS = 5; // [px] between samples from which each is a dot of its own

export class Chart {
  constructor(still, moving, { onCursor, onSpans }) {
    this.still = still;
    this.moving = moving;
    this.onCursor = onCursor;
    this.onSpans = onSpans;
    this.showsSignals = false;
    this.dragMarks = true; // in the view of the signals; Shift turns it round
    this.spans = new Map();
    this.pictures = 0;
    this.runs = [];
    this.faults = [];
    this.others = [];
    this.simulated = [];
    this.noise = null;
    this.cursor = null;
    new ResizeObserver(() => this.resize()).observe(still.parentElement);
    listen(this);
  }

  /** Show a log: its runs, with samples in the log's own unit. */
  setLog({ runs, faults, symbol }) {
    this.runs = runs;
    this.faults = faults;
    this.symbol = symbol;
    this.simulated = [];
    this.noise = null;
    this.cursor = null;
    this.timeline = new Timeline(runs);
    this.spans = new Map();
    this.derived = null;
    const [low, high] = rangeOf(runs.map((run) => run.velocity));
    const pad = 0.07 * (high - low || 1);
    const [least, most] = rangeOf(runs.map((run) => run.voltage));
    this.ranges = {
      velocity: [Math.min(low, 0) - pad, Math.max(high, 0) + pad],
      voltage: [Math.min(least, 0) - 0.6, Math.max(most, 0) + 0.6],
    };
    this.prepareSignals();
    this.showAll();
  }

  /** Show the signals of the log alone, or what was measured against what is simulated. */
  showSignals(on) {
    this.showsSignals = on;
    this.prepareSignals();
    this.resize();
  }

  /** Time steps and slopes, once they are needed. */
  prepareSignals() {
    if (!this.showsSignals || !this.timeline || this.derived) return;
    this.derived = deriveSignals(this.runs);
    this.signalRanges = signalRanges(this.runs, this.derived, this.ranges);
  }

  get panelsShown() {
    return this.showsSignals ? SIGNAL_PANELS : FIT_PANELS;
  }

  /** The lowest and the highest value that a panel shows. */
  rangeOfPanel(name) {
    if (name === "error") return this.errors();
    return (this.showsSignals ? this.signalRanges : this.ranges)[name];
  }

  /** Mark a span of a run, from one sample to another; null removes it. */
  setSpan(run, span) {
    if (span) this.spans.set(run, span);
    else this.spans.delete(run);
    this.onSpans(this.spans);
    this.requestMoving();
  }

  /** Mark faults: {run, start, end, name}. */
  setFaults(faults) {
    this.faults = faults;
    this.redraw();
  }

  /** Lay runs of another log over those of the same test: {color, run, time, velocity}. */
  setOthers(others) {
    this.others = others;
    this.redraw();
  }

  /** The simulated curves, {first, velocity} or null for each run; the picture comes at once. */
  setSimulation(simulated, noise) {
    this.simulated = simulated;
    this.noise = noise;
    this.requestMoving();
  }

  /** Zoom to a stretch of the axis, with some room on both sides. */
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

  /** Fit the canvases to their place, in real pixels. */
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
    this.left = clientWidth < 560 ? 40 : 54;
    this.right = clientWidth - (clientWidth < 560 ? 8 : 14);
    let y = TOP;
    const room = clientHeight - TOP - AXIS - OVERVIEW - GAP * (this.panelsShown.length - 1) - 10;
    this.panels = {};
    for (const { name, share } of this.panelsShown) {
      this.panels[name] = { top: y, bottom: y + share * room };
      y += share * room + GAP;
    }
    this.bottom = y - GAP;
    this.overview = { top: clientHeight - OVERVIEW, bottom: clientHeight - 4 };
    this.redraw();
  }

  /** Read the colors of the theme anew. */
  readColors() {
    const style = getComputedStyle(document.documentElement);
    const names = ["ink", "quiet", "rule", "card", "measured", "simulated", "volts", "fault", "band", "stripe", "position", "mark"];
    this.colors = Object.fromEntries(names.map((one) => [one, style.getPropertyValue(`--${one}`).trim()]));
    this.redraw();
  }

  xOf(place) {
    return this.left + ((place - this.view[0]) / (this.view[1] - this.view[0])) * (this.right - this.left);
  }

  placeOfX(x) {
    return this.view[0] + ((x - this.left) / (this.right - this.left)) * (this.view[1] - this.view[0]);
  }

  /** From a value to a height in a panel. */
  heights(name) {
    const { top, bottom } = this.panels[name];
    const [low, high] = this.rangeOfPanel(name);
    return (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
  }

  /** How far the error's panel reaches, in round steps so that it does not tremble. */
  errors() {
    let most = 6 * (this.noise ?? 0);
    for (const [k, one] of this.simulated.entries()) {
      if (!one) continue;
      const { velocity } = this.runs[k];
      for (let i = 0; i < one.velocity.length; i++) {
        const left = Math.abs(velocity[one.first + i] - one.velocity[i]);
        if (left > most) most = left;
      }
    }
    most = Math.min(most, this.ranges.velocity[1] - this.ranges.velocity[0]) || 1;
    const power = 10 ** Math.floor(Math.log10(most));
    const round = [1, 1.5, 2, 3, 5, 7, 10].map((one) => one * power).find((one) => one >= most);
    return [-round, round];
  }

  // ---- what stands still

  drawStill() {
    const to = this.still.getContext("2d");
    to.clearRect(0, 0, this.width, this.height);
    to.font = "11px ui-sans-serif, system-ui, sans-serif";
    this.drawRuns(to);
    this.drawFaults(to);
    for (const { name } of this.panelsShown) if (name !== "error") this.drawGrid(to, name);
    if (this.showsSignals) drawSignals(this, to);
    this.clip(to, () => {
      if (!this.showsSignals) for (const run of this.runs.keys()) this.drawMeasured(to, run);
      for (const other of this.others) this.drawOther(to, other);
    });
    this.drawTimes(to);
    this.drawOverview(to);
  }

  /** Draw nothing beside the runs; with the name of a panel, nothing beside that panel. */
  clip(to, draw, name) {
    const { top, bottom } = this.panels[name] ?? { top: 8, bottom: this.overview.top - AXIS - 2 };
    to.save();
    to.beginPath();
    to.rect(this.left - 3, top - 8, this.right - this.left + 3, bottom - top + 14);
    to.clip();
    draw();
    to.restore();
  }

  /** A stripe and a name for each run. */
  drawRuns(to) {
    const { stripe, ink, quiet } = this.colors;
    const { bottom } = this;
    this.clip(to, () => {
      for (const [k, run] of this.runs.entries()) {
        const [from, end] = this.timeline.spanOf(k).map((place) => this.xOf(place));
        if (end < this.left || from > this.right) continue;
        to.fillStyle = stripe;
        to.beginPath();
        to.roundRect(from - 3, TOP - 22, Math.max(end - from + 6, 3), bottom - TOP + 26, 6);
        to.fill();
        const begins = Math.max(from, this.left) + 2;
        const room = Math.min(end, this.right) - begins;
        const [kind, way] = [run.test.replace(/-\w+$/, ""), run.test.endsWith("forward") ? "→" : "←"];
        to.textBaseline = "alphabetic";
        for (const text of [`${run.part ? `${run.part} ` : ""}${kind} ${way}`, `${kind.slice(0, 4)}. ${way}`, way]) {
          if (to.measureText(text).width > room) continue;
          to.fillStyle = k === this.cursor?.run ? ink : quiet;
          to.fillText(text, begins, TOP - 30);
          break;
        }
      }
    });
  }

  drawFaults(to) {
    const { fault } = this.colors;
    let free = 0;
    to.textBaseline = "alphabetic";
    this.clip(to, () => {
      for (const one of this.faults) {
        const from = this.xOf(this.timeline.placeOf(one.run, one.start));
        const end = Math.max(this.xOf(this.timeline.placeOf(one.run, one.end)), from + 2);
        to.globalAlpha = 0.14;
        to.fillStyle = fault;
        to.fillRect(from, TOP - 22, end - from, this.bottom - TOP + 26);
        to.globalAlpha = 1;
        to.fillRect(from, TOP - 22, end - from, 3);
        const width = to.measureText(one.name).width;
        const at = Math.max(Math.min(from, this.right - width - 6), this.left);
        if (from < this.right && end > this.left && at > free) {
          to.fillText(one.name, at + 1, TOP - 7);
          free = at + width + 8;
        }
      }
    });
  }

  drawGrid(to, name) {
    const { rule, quiet } = this.colors;
    const title = TITLES[name](this);
    const y = this.heights(name);
    const [low, high] = this.rangeOfPanel(name);
    to.textBaseline = "middle";
    const { top, bottom } = this.panels[name];
    const apart = name === "velocity" && !this.showsSignals ? 38 : 22; // [px]
    const count = Math.max(3, Math.floor((bottom - top) / apart));
    for (const tick of roundTicks(low, high, count)) {
      const at = Math.round(y(tick)) + 0.5;
      to.strokeStyle = rule;
      to.lineWidth = Math.abs(tick) < 1e-9 * (high - low) ? 1.6 : 0.8;
      line(to, this.left, at, this.right, at);
      to.fillStyle = quiet;
      to.textAlign = "right";
      to.fillText(short(tick), this.left - 7, at);
    }
    to.textAlign = "left";
    to.textBaseline = "alphabetic";
    to.fillStyle = quiet;
    to.globalAlpha = 0.9;
    to.textBaseline = "top";
    if (name === this.panelsShown[0].name) {
      to.fillText(title, this.left + 5, top - 3);
    } else {
      to.textBaseline = "alphabetic";
      to.fillText(title, this.left + 5, top - 6);
    }
    to.textBaseline = "alphabetic";
    to.globalAlpha = 1;
  }

  drawMeasured(to, run) {
    const { measured, volts } = this.colors;
    const { velocity, voltage } = this.runs[run];
    const y = this.heights("velocity");
    this.curve(to, run, 0, velocity, y, { color: measured, width: 5, alpha: 0.42, dots: true });
    this.curve(to, run, 0, voltage, this.heights("voltage"), { color: volts, width: 1.5, steps: true });
  }

  drawOther(to, { color, run, time, velocity }) {
    const y = this.heights("velocity");
    to.strokeStyle = color;
    to.lineWidth = 1.3;
    to.globalAlpha = 0.75;
    to.beginPath();
    const stride = Math.max(1, Math.floor(time.length / 4000));
    const [begins, end] = this.timeline.spanOf(run); // a longer run of another log ends with ours
    for (let k = 0; k < time.length && begins + time[k] - time[0] <= end; k += stride) {
      to.lineTo(this.xOf(begins + time[k] - time[0]), y(velocity[k]));
    }
    to.stroke();
    to.globalAlpha = 1;
  }

  /** One curve of one run; where samples are closer than pixels, from lowest to highest. */
  curve(to, run, first, values, y, { color, width, alpha = 1, dots = false, steps = false }) {
    const { time } = this.runs[run];
    const begins = this.timeline.offsets[run] - time[0];
    const from = Math.max(firstNotBefore(time, this.view[0] - begins) - 1, first);
    const end = Math.min(firstNotBefore(time, this.view[1] - begins) + 1, first + values.length);
    if (end - from < 1) return;
    const apart = (this.xOf(begins + time[end - 1]) - this.xOf(begins + time[from])) / Math.max(end - from - 1, 1);
    to.globalAlpha = alpha;
    to.strokeStyle = to.fillStyle = color;
    to.lineWidth = width;
    to.lineJoin = "round";
    to.beginPath();
    if (apart >= 0.5) {
      let last = 0;
      for (let k = from; k < end; k++) {
        const [x, height] = [this.xOf(begins + time[k]), y(values[k - first])];
        if (steps && k > from) to.lineTo(x, last);
        to.lineTo(x, height);
        last = height;
      }
      to.stroke();
      if (dots && apart >= DOTS) {
        to.globalAlpha = 1;
        for (let k = from; k < end; k++) {
          to.beginPath();
          to.arc(this.xOf(begins + time[k]), y(values[k - first]), 2.4, 0, 7);
          to.fill();
        }
      }
    } else {
      for (let k = from; k < end; ) {
        const x = Math.round(this.xOf(begins + time[k]));
        let [low, high] = [Infinity, -Infinity];
        for (; k < end && Math.round(this.xOf(begins + time[k])) === x; k++) {
          low = Math.min(low, values[k - first]);
          high = Math.max(high, values[k - first]);
        }
        to.lineTo(x, y(low));
        to.lineTo(x, y(high));
      }
      to.stroke();
    }
    to.globalAlpha = 1;
  }

  /** Times below the runs: in the log's own time, or since each test began in the view of the signals. */
  drawTimes(to) {
    const { quiet, rule } = this.colors;
    const at = this.bottom + 17;
    to.fillStyle = quiet;
    to.textAlign = "center";
    const apart = (70 / (this.right - this.left)) * (this.view[1] - this.view[0]);
    let free = this.left;
    for (const [k, run] of this.runs.entries()) {
      if (!run.time.length) continue;
      const begins = this.showsSignals ? run.time[0] : 0;
      const [from, end] = [run.time[0] - begins, run.time[run.time.length - 1] - begins];
      for (const tick of roundTicks(from, end, Math.max((end - from) / apart, 1))) {
        const x = this.xOf(this.timeline.placeOf(k, begins + tick));
        const text = `${short(tick)} s`;
        const half = to.measureText(text).width / 2;
        if (x - half < free || x + half > this.right + 6) continue;
        to.fillText(text, x, at);
        to.strokeStyle = rule;
        line(to, x, this.bottom + 3, x, this.bottom + 6);
        free = x + half + 10;
      }
    }
    to.textAlign = "left";
  }

  /** The whole log in small, and which part of it is seen. */
  drawOverview(to) {
    const { top, bottom } = this.overview;
    const { measured, simulated, rule, fault, stripe } = this.colors;
    const x = (place) => this.left + (place / this.timeline.end) * (this.right - this.left);
    const [low, high] = this.ranges.velocity;
    const y = (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
    to.strokeStyle = measured;
    to.globalAlpha = 0.85;
    to.lineWidth = 1.2;
    for (const [k, run] of this.runs.entries()) {
      const [from, end] = this.timeline.spanOf(k).map(x);
      to.fillStyle = stripe;
      to.fillRect(from, top, Math.max(end - from, 1), bottom - top);
      const stride = Math.max(1, Math.floor(run.time.length / 400));
      to.beginPath();
      for (let i = 0; i < run.time.length; i += stride) {
        to.lineTo(x(this.timeline.placeOf(k, run.time[i])), y(run.velocity[i]));
      }
      to.stroke();
    }
    to.globalAlpha = 1;
    to.fillStyle = fault;
    for (const one of this.faults) {
      const from = x(this.timeline.placeOf(one.run, one.start));
      to.fillRect(from, top, Math.max(x(this.timeline.placeOf(one.run, one.end)) - from, 2), 3);
    }
    const seen = this.view.map((place) => Math.min(Math.max(x(place), this.left), this.right));
    to.strokeStyle = rule;
    to.lineWidth = 1;
    to.strokeRect(this.left + 0.5, top + 0.5, this.right - this.left - 1, bottom - top - 1);
    if (seen[1] - seen[0] < this.right - this.left - 2) {
      to.globalAlpha = 0.12;
      to.fillStyle = simulated;
      to.fillRect(seen[0], top, seen[1] - seen[0], bottom - top);
      to.globalAlpha = 1;
      to.strokeStyle = simulated;
      to.lineWidth = 1.5;
      to.strokeRect(seen[0] + 0.5, top + 0.5, seen[1] - seen[0] - 1, bottom - top - 1);
    }
  }

  // ---- what moves

  drawMoving() {
    const to = this.moving.getContext("2d");
    to.clearRect(0, 0, this.width, this.height);
    to.font = "11px ui-sans-serif, system-ui, sans-serif";
    if (this.showsSignals) {
      this.clip(to, () => this.drawSpans(to));
      if (this.cursor) this.drawCursor(to, signalMarks(this, this.cursor));
      return;
    }
    this.drawGrid(to, "error");
    const [y, height] = [this.heights("velocity"), this.heights("error")];
    this.clip(to, () => {
      if (this.noise) {
        to.fillStyle = this.colors.band;
        to.fillRect(this.left, height(2 * this.noise), this.right - this.left, height(-2 * this.noise) - height(2 * this.noise));
      }
      for (const [k, one] of this.simulated.entries()) {
        if (!one) continue;
        const left = one.velocity.map((value, i) => this.runs[k].velocity[one.first + i] - value);
        this.curve(to, k, one.first, left, height, { color: this.colors.simulated, width: 1.2, alpha: 0.9 });
        this.clip(to, () => {
          this.curve(to, k, one.first, one.velocity, y, { color: this.colors.simulated, width: 1.8 });
        }, "velocity");
      }
    });
    if (this.cursor) this.drawCursor(to, this.fitMarks(y, height));
  }

  /** Height and color of each value at the cursor. */
  fitMarks(y, height) {
    const { run, sample } = this.cursor;
    const { velocity, voltage } = this.runs[run];
    const { measured, simulated, volts } = this.colors;
    const one = this.simulated[run];
    const guess = one && sample >= one.first ? one.velocity[sample - one.first] : null;
    const marks = [[y(velocity[sample]), measured], [this.heights("voltage")(voltage[sample]), volts]];
    if (guess !== null) marks.push([y(guess), simulated], [height(velocity[sample] - guess), simulated]);
    return marks;
  }

  /** The spans that a person marked, each with two edges to take hold of. */
  drawSpans(to) {
    const { mark } = this.colors;
    for (const [run, span] of this.spans) {
      const [from, end] = span.map((sample) => this.xOf(this.timeline.placeOf(run, this.runs[run].time[sample])));
      to.fillStyle = mark;
      to.globalAlpha = 0.2;
      to.fillRect(from, TOP - 22, Math.max(end - from, 1), this.bottom - TOP + 26);
      to.globalAlpha = 1;
      for (const x of [from, end]) {
        to.fillRect(x - 0.75, TOP - 22, 1.5, this.bottom - TOP + 26);
        to.beginPath();
        to.roundRect(x - 3, TOP + 2, 6, 22, 3);
        to.fill();
      }
    }
  }

  drawCursor(to, marks) {
    const { run, sample } = this.cursor;
    const x = this.xOf(this.timeline.placeOf(run, this.runs[run].time[sample]));
    if (x < this.left - 1 || x > this.right + 1) return;
    const { ink, card } = this.colors;
    to.strokeStyle = ink;
    to.globalAlpha = 0.55;
    to.lineWidth = 1;
    line(to, Math.round(x) + 0.5, TOP - 22, Math.round(x) + 0.5, this.bottom + 4);
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

  // ---- moving about

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
