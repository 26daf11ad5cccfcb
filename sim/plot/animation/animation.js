// An animated mechanism and plots of its motion, with a common time cursor.
//
// The page holds <figure class="motion" data-motion> with its data as JSON (see __init__.py). Each
// copy of this script starts every such figure that was not started yet, so that it works in an
// output of JupyterLab and in a page without a server.

import { makeModel, rms, simulateRun } from "./simulate.js";
import { Charts, addKnobs, create, drawAxes, drawKey, rounded } from "./charts.js";
import { STAGES, draw } from "./stages.js";

const SHORTEST = 3; // [s] least duration of a play: shorter scenes are shown in slow motion
const LONGEST = 12; // [s] largest duration of a play
const HIGH = { one: 170, many: 120 }; // [px] height of a single panel or one with areas, and of one of several
const MARGIN = 0.08; // [1] margin of an axis, relative to the range of its values
const FLOORS = ["drivetrain", "swerve"]; // kinds that drive on a floor
const LONG = 0.9, BEHIND = 0.16; // [m] a robot with bumpers; [1] most of the floor drawn behind its start
const MOVES = 0.02; // [m/s] slower counts as standing
const TERMS = [["kS·sgn(v)", 0], ["kV·v", 1], ["kA·a", 2]]; // a term and its color

/** The value of a number, or of a gain that a knob sets. */
const resolve = (value, knobs) =>
  (value === null || typeof value === "number" ? value : value.plus + value.times * knobs[value.knob]);

const resolveAll = (values, knobs) =>
  Object.fromEntries(Object.entries(values).map(([name, value]) => [name, resolve(value, knobs)]));

/** The volts of a feedforward for a target velocity, each held until the next time. */
export function feedforward({ time, target }, gains) {
  return time.map((now, k) => {
    if (k + 1 >= time.length) return 0;
    const velocity = (target[k] + target[k + 1]) / 2;
    const acceleration = (target[k + 1] - target[k]) / (time[k + 1] - now);
    return gains.kS * Math.sign(velocity) + gains.kV * velocity + gains.kA * acceleration + (gains.kG ?? 0);
  });
}

/** A motion with its signals, which are simulated if the motion has gains. */
function moveMotion(motion, scene, knobs) {
  if (!motion.gains) return motion;
  const gains = resolveAll(motion.gains, knobs);
  const model = makeModel(motion.type, gains);
  const start = { position: motion.start, velocity: 0 };
  const move = (voltage) => simulateRun({ time: scene.time, voltage }, model, start);
  const voltage = findVoltage(motion, scene, knobs, move);
  const moved = move(voltage);
  return { ...motion, voltage, gains, position: [...moved.position], velocity: [...moved.velocity] };
}

function findVoltage(motion, scene, knobs, move) {
  if (motion.plan) return driveTest(resolveAll(motion.plan, knobs), scene.time, move);
  if (motion.program) return feedforward(scene, resolveAll(motion.program, knobs));
  return Array.isArray(motion.voltage) ? motion.voltage
    : scene.time.map(() => resolve(motion.voltage, knobs) ?? 0);
}

/** The volts of a test that ends when the mark was passed and the driver has reacted. */
function driveTest({ ramp, step, mark, reaction, timeout }, time, move) {
  const asked = time.map((now) => (now < (timeout ?? Infinity) ? step + ramp * now : 0));
  const passed = move(asked).position.findIndex((place) => place > (mark ?? Infinity));
  return passed < 0 ? asked : asked.map((volts, k) => (time[k] < time[passed] + reaction ? volts : 0));
}

/** Each position minus the target position. */
function addErrors(motions) {
  const asked = motions.find((motion) => motion.asked);
  return motions.map((motion) => ({
    ...motion,
    error: asked && motion !== asked ? motion.position.map((x, k) => x - asked.position[k]) : null,
  }));
}

class Animation {
  constructor(figure, data) {
    this.figure = figure;
    this.data = data;
    this.now = 0;
    this.playing = false;
    this.pictures = 0;
    this.tries = 0;
    addKnobs(this, (slid) => { if (slid) this.count(); this.change(); });
    this.fitAxes();
    this.build();
    this.compute();
    new ResizeObserver(() => this.fit()).observe(figure);
    this.fit();
    this.playWhenSeen();
  }

  /** Create the parts that do not depend on the width: the clock, and containers of the drawings. */
  build() {
    const { data, figure } = this;
    if (data.rules.length) this.rules = create(figure, "ul", { className: "motion-rules" });
    if (data.score) this.score = create(figure, "p", { className: "motion-score" });
    this.title = create(figure, "p", { className: "motion-title" });
    this.both = create(figure, "div", { className: "motion-both" });
    this.stage = create(this.both, "div");
    this.panels = create(this.both, "div", { className: "motion-panels" });
    const clock = create(figure, "div", { className: "motion-clock" });
    this.button = create(clock, "button", { type: "button", className: "play" });
    this.button.addEventListener("click", () => this.toggle());
    this.cursor = create(clock, "input", { type: "range", min: 0, max: 1, step: "any", value: 0 });
    this.cursor.setAttribute("aria-label", "time");
    this.cursor.addEventListener("input", () => { this.pause(); this.show(Number(this.cursor.value)); });
    this.time = create(clock, "output");
    figure.addEventListener("keydown", (event) => this.press(event));
    this.pause();
  }

  /** Space plays and pauses; arrows on the time line move the cursor by a hundredth. */
  press(event) {
    event.stopPropagation(); // so that the notebook does not handle the key
    if (event.key === " " && event.target !== this.button && event.target.tagName !== "SELECT") {
      event.preventDefault();
      this.toggle();
    }
    const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (way && event.target === this.cursor) {
      event.preventDefault();
      this.pause();
      this.show(this.now + way * this.duration / 100);
    }
  }

  /** Count a try; the time limit starts with the first. */
  count() {
    this.tries++;
    if (this.began !== undefined || !this.data.score?.seconds) return;
    this.began = performance.now();
    const tick = setInterval(() => {
      this.rank();
      if (performance.now() - this.began > 1000 * this.data.score.seconds) clearInterval(tick);
    }, 500);
  }

  change() {
    this.compute();
    this.fit(true);
  }

  /** Fit the axes that are not given to all scenes as first shown, with zero and a margin. */
  fitAxes() {
    const { stage, panels, scenes } = this.data;
    const motions = Object.values(scenes).flatMap((scene) => this.simulate(scene).motions);
    const fit = (axis, signal, scale = 1) => {
      let [low, high] = [0, 0];
      for (const value of motions.flatMap((motion) => motion[signal] ?? [])) {
        low = Math.min(low, scale * value);
        high = Math.max(high, scale * value);
      }
      axis.low ??= low - (low < 0 ? MARGIN * (high - low || 1) : 0);
      axis.high ??= high + MARGIN * (high - low || 1);
    };
    for (const panel of panels) fit(panel, panel.signal, panel.scale);
    const behind = stage.low === null && FLOORS.includes(stage.kind); // a position is that of the front bumper
    fit(stage, "position");
    if (behind) stage.low -= Math.min(LONG, BEHIND * (stage.high - stage.low));
  }

  /** A scene with its motions, simulated with the current values of the knobs. */
  simulate(scene) {
    return { ...scene, motions: addErrors(scene.motions.map((motion) => moveMotion(motion, scene, this.knobs))) };
  }

  /** Simulate the selected scene. */
  compute() {
    const scene = this.scene = this.simulate(this.data.scenes[this.picked.join("|")]);
    this.duration = scene.time.at(-1) - scene.time[0];
    this.rate = this.duration / Math.min(Math.max(this.duration, SHORTEST), LONGEST);
    this.cursor.max = this.duration;
    this.title.textContent = scene.title;
    this.title.hidden = !scene.title;
    if (this.data.score) this.rank();
    if (this.rules) this.judge();
  }

  /** Tick the rules that the plan meets. */
  judge() {
    this.rules.replaceChildren();
    for (const rule of this.data.rules) {
      const value = rule.times * this.measure(rule);
      const most = resolve(rule.at_most, this.knobs);
      const kept = value <= (most ?? Infinity) && value >= (rule.at_least ?? -Infinity);
      const bound = most === null ? `at least ${rule.at_least}` : `at most ${+most.toFixed(2)}`;
      const item = create(this.rules, "li", { className: kept ? "kept" : "broken" });
      create(item, "b", { textContent: kept ? "✓ " : "✗ " });
      create(item, "span", { textContent: `${rule.label}: ` });
      create(item, "b", { textContent: rounded(value, value < 10 ? 2 : 0) });
      create(item, "span", { textContent: ` (${bound})${kept ? "" : ", broken"}` });
    }
  }

  measure({ measure, motion }) {
    const { motions, time } = this.scene;
    const meant = motions.filter(({ name }) => !motion || name === motion);
    if (measure === "farthest") return Math.max(...meant.flatMap(({ position }) => position));
    if (measure === "fastest") return Math.max(...meant.flatMap(({ velocity }) => velocity));
    if (measure === "moving") {
      return meant[0].velocity.filter((v) => v > MOVES).length * (time[1] - time[0]);
    }
    return this.knobs[measure];
  }

  /** Show the error of the scored motion, and the best try. */
  rank() {
    const { motion, unit, seconds } = this.data.score;
    const { motions, target } = this.scene;
    const error = rms(motions.find((one) => one.name === motion).velocity, target);
    const spent = this.began === undefined ? 0 : (performance.now() - this.began) / 1000;
    const counts = this.tries > 0 && !(seconds && spent > seconds);
    if (counts && !(this.best?.error <= error)) this.best = { error, knobs: { ...this.knobs } };
    this.score.replaceChildren();
    create(this.score, "span", { textContent: "typical error " });
    create(this.score, "b", { textContent: `${rounded(error, 3)} ${unit}` });
    const said = [];
    if (seconds && this.tries) said.push(spent > seconds ? "time is up" : `${Math.ceil(seconds - spent)} s left`);
    if (this.best) {
      const gains = this.data.knobs.map(({ name }) => `${name} = ${+this.best.knobs[name].toFixed(3)}`);
      said.push(`best: ${rounded(this.best.error, 3)} with ${gains.join(", ")}`);
    }
    create(this.score, "span", { textContent: said.map((one) => ` · ${one}`).join("") });
  }

  /** Draw for the current width, if the width or the scene has changed. */
  fit(changed = false) {
    const width = Math.round(this.figure.clientWidth);
    if (!width || (width === this.width && !changed)) return;
    this.width = width;
    const { stage } = this.data;
    const upright = !FLOORS.includes(stage.kind);
    const crowd = this.scene.motions.filter(({ ghost }) => !ghost).length;
    const beside = upright && width >= 600 && crowd <= 2;
    this.both.classList.toggle("stacked", !beside);
    const wide = beside ? 240 : width;
    const motions = this.scene.motions.map((motion) => ({ ...motion, color: this.color(motion) }));
    this.stage.replaceChildren();
    const svg = draw(this.stage, "svg", { width: wide, role: "img", "aria-label": stage.words });
    const wall = resolve(stage.wall, this.knobs);
    const marks = stage.marks.map(({ label, at }) => ({ label, at: resolve(at, this.knobs) }));
    this.mover = STAGES[stage.kind](svg, { ...stage, wall, marks }, motions, wide);
    svg.setAttribute("height", this.mover.height);
    this.panels.replaceChildren();
    const room = beside ? width - wide - 12 : width;
    this.lines = this.data.panels.map((panel) => this.drawPanel(panel, room));
    this.show(this.now);
  }

  color(motion) {
    return motion.color === null ? "currentColor" : this.data.colors[motion.color];
  }

  /** Draw one plot over time: fixed axes, its curves, and a line for the cursor. */
  drawPanel(panel, width) {
    const shown = this.scene.motions.filter((motion) => motion[panel.signal]?.length);
    const now = create(this.panels, "ul", { className: "motion-now" });
    create(now, "li", { textContent: panel.label });
    const values = panel.terms ? [] : shown.map((motion) => drawKey(now, motion.name, this.color(motion), motion.dash));
    const high = this.data.panels.length > 1 && !panel.terms ? HIGH.many : HIGH.one;
    const svg = draw(this.panels, "svg", { width, height: high, role: "img" });
    svg.setAttribute("aria-label", `${panel.label} over time: ${shown.map(({ name }) => name).join(", ")}`);
    const begin = this.scene.time[0];
    const { toX, toY, left, right, top, bottom } = drawAxes(svg, {
      width, height: high, x: [begin, begin + this.duration], y: [panel.low, panel.high],
    });
    const path = (values) => values.map((value, k) =>
      `${toX(this.scene.time[k]).toFixed(1)},${toY(value).toFixed(1)}`).join(" ");
    if (panel.terms) this.drawTerms(svg, now, { toX, toY });
    for (const motion of shown) {
      draw(svg, "polyline", {
        points: path(motion[panel.signal].map((value) => value * panel.scale)), fill: "none", stroke: panel.terms ? "currentColor" : this.color(motion),
        "stroke-width": 2, "stroke-dasharray": motion.dash, "stroke-linejoin": "round",
      });
    }
    const line = draw(svg, "line", { y1: top, y2: bottom, stroke: "currentColor", "stroke-width": 1.5 });
    const dots = shown.map((motion) => draw(svg, "circle", { r: 4, fill: this.color(motion), stroke: "currentColor" }));
    const drag = (event) => {
      this.pause();
      const share = (event.clientX - svg.getBoundingClientRect().left - left) / (right - left);
      this.show(Math.min(Math.max(share, 0), 1) * this.duration);
    };
    svg.addEventListener("pointerdown", (event) => { svg.setPointerCapture(event.pointerId); drag(event); });
    svg.addEventListener("pointermove", (event) => { if (event.buttons) drag(event); });
    svg.style.cursor = "ew-resize";
    return { panel, shown, values, line, dots, toX, toY };
  }

  /** Draw the shares of kS, kV and kA in the first motion's volts, stacked from zero. */
  drawTerms(svg, now, { toX, toY }) {
    const { time, motions: [{ gains, velocity }] } = this.scene;
    const middle = velocity.slice(1).map((after, k) => (velocity[k] + after) / 2);
    const takes = [
      middle.map((v) => gains.kS * Math.sign(v)),
      middle.map((v) => gains.kV * v),
      velocity.slice(1).map((after, k) => (gains.kA * (after - velocity[k])) / (time[k + 1] - time[k])),
    ];
    for (const term of takes) term.push(term.at(-1)); // hold the last value to the end
    const [above, below] = [takes[0].map(() => 0), takes[0].map(() => 0)];
    for (const [name, color] of TERMS) {
      for (const [edge, part] of [[above, Math.max], [below, Math.min]]) {
        const next = edge.map((value, k) => value + part(takes[color][k], 0));
        const there = edge.map((value, k) => `${toX(time[k]).toFixed(1)},${toY(value).toFixed(1)}`);
        const back = next.map((value, k) => `${toX(time[k]).toFixed(1)},${toY(value).toFixed(1)}`).reverse();
        draw(svg, "polygon", { points: [...there, ...back].join(" "), fill: this.data.colors[color], opacity: 0.55 });
        next.forEach((value, k) => { edge[k] = value; });
      }
      takes[color].shown = drawKey(now, name, this.data.colors[color]);
    }
    create(now, "li", { textContent: "line: applied" });
    this.takes = takes;
  }

  /** Put cursor, numbers and mechanism at a time [s] since the scene's start. */
  show(time) {
    const { scene } = this;
    this.now = Math.min(Math.max(time, 0), this.duration);
    const at = scene.time[0] + this.now;
    const last = scene.time.length - 2; // the last interval also holds the end
    let k = Math.min(Math.floor((this.now / this.duration) * last), last);
    while (k > 0 && scene.time[k] > at) k--;
    while (k < last && scene.time[k + 1] <= at) k++;
    const share = (at - scene.time[k]) / (scene.time[k + 1] - scene.time[k]);
    const read = (values, held = false) =>
      values?.length ? (held ? values[share < 1 ? k : k + 1] : values[k] + share * (values[k + 1] - values[k])) : 0;
    this.states = scene.motions.map((motion) => ({
      position: read(motion.position), velocity: read(motion.velocity), heading: read(motion.heading),
    }));
    this.mover.move(this.states);
    for (const { panel, shown, values, line, dots, toX, toY } of this.lines) {
      line.setAttribute("x1", toX(at));
      line.setAttribute("x2", toX(at));
      shown.forEach((motion, i) => {
        const value = panel.scale * read(motion[panel.signal], panel.signal === "voltage");
        dots[i].setAttribute("cx", toX(at));
        dots[i].setAttribute("cy", toY(value));
        if (values[i]) values[i].textContent = rounded(value);
      });
      if (panel.terms) for (const term of this.takes) term.shown.textContent = rounded(term[Math.min(k, term.length - 1)]);
    }
    this.cursor.value = this.now;
    this.time.textContent = `${rounded(this.now)} s`;
    this.cursor.setAttribute("aria-valuetext", this.words());
    this.pictures++;
  }

  /** A description of the state at the cursor, for a screen reader. */
  words() {
    const { unit } = this.data.stage;
    const each = this.scene.motions.map(({ name }, i) =>
      `${name} at ${rounded(this.states[i].position)} ${unit}, ${rounded(this.states[i].velocity)} ${unit}/s`);
    return `${rounded(this.now)} seconds: ${each.join("; ")}`;
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  pause() {
    this.playing = false;
    this.button.textContent = "▶ Play";
    this.button.setAttribute("aria-label", "Play");
  }

  play() {
    if (this.now >= this.duration - 1e-9) this.show(0);
    this.playing = true;
    this.button.textContent = "❚❚ Pause";
    this.button.setAttribute("aria-label", "Pause");
    let last = null;
    const frame = (stamp) => {
      if (!this.playing || !this.figure.isConnected) return;
      if (last !== null) this.show(this.now + ((stamp - last) / 1000) * this.rate);
      last = stamp;
      if (this.now >= this.duration) this.pause();
      else requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  /** Play once when the figure becomes visible, unless the user prefers reduced motion. */
  playWhenSeen() {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    const watch = new IntersectionObserver(([{ isIntersecting }]) => {
      if (!isIntersecting) return;
      watch.disconnect();
      if (this.now === 0) this.play();
    }, { threshold: 0.6 });
    watch.observe(this.figure);
  }
}

for (const figure of document.querySelectorAll("figure[data-motion]:not([data-alive])")) {
  figure.dataset.alive = "";
  figure.querySelector(".motion-still").hidden = true;
  const data = JSON.parse(figure.querySelector("script").textContent);
  figure.animation = data.frames ? new Charts(figure, data) : new Animation(figure, data);
}
