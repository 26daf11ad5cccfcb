// Menus and sliders, axes, and charts whose curves the menus and sliders select.

import { draw } from "./stages.js";
import { roundTicks, short } from "./ticks.js";

const EDGE = { left: 46, right: 14, top: 6, bottom: 22 };
const CHART = { plain: 240, row: 27, label: 16, letter: 7, note: 50, column: 330 }; // [px] heights, widths
const STYLES = {
  line: { fill: "none", "stroke-width": 2 },
  dashed: { fill: "none", "stroke-width": 1.5, "stroke-dasharray": "7 4" },
  dots: { fill: "none", "stroke-width": 6 },
  bar: { fill: "none", "stroke-width": 16, opacity: 0.6 },
  area: { "stroke-width": 0, opacity: 0.3 },
};

/** A number with so many digits after the point, and a minus sign (−). */
export const rounded = (value, digits = 2) => value.toFixed(digits).replace(/^-(?=0\.?0*$)/, "").replace("-", "−");

/** A new element inside another one. */
export const create = (parent, name, properties = {}) => {
  const element = Object.assign(document.createElement(name), properties);
  parent.append(element);
  return element;
};

/** Add the menus, which set `picked` of a figure's owner, and the sliders, which set its `knobs`.
 *
 * @param change is called after each, with whether it was a slider.
 */
export function addKnobs(owner, change) {
  const { data, figure } = owner;
  owner.knobs = Object.fromEntries(data.knobs.map((knob) => [knob.name, knob.value]));
  owner.picked = data.choices.map((choice) => choice.value);
  const knobs = create(figure, "div", { className: "motion-knobs" });
  data.choices.forEach((choice, at) => {
    const label = create(knobs, "label");
    create(label, "span", { textContent: choice.label });
    const menu = create(label, "select");
    for (const option of choice.options) create(menu, "option", { textContent: option, value: option });
    menu.value = choice.value;
    menu.addEventListener("change", () => { owner.picked[at] = menu.value; change(false); });
  });
  for (const knob of data.knobs) {
    const label = create(knobs, "label");
    create(label, "span", { textContent: knob.label });
    const { low: min, high: max, step } = knob;
    const slider = create(label, "input", { type: "range", min, max, step, value: knob.value, ariaLabel: knob.label });
    const digits = `${step}`.split(".")[1]?.length ?? 0;
    const shown = create(label, "output", { textContent: rounded(knob.value, digits) });
    slider.addEventListener("input", () => {
      owner.knobs[knob.name] = Number(slider.value);
      shown.textContent = rounded(Number(slider.value), digits);
      change(true);
    });
  }
  if (!knobs.childElementCount) knobs.remove();
}

/** Draw two axes with ticks, or rows with names: functions from values to pixels, and the edges. */
export function drawAxes(svg, { width, height, x, y, rows = [], xlabel }) {
  const left = Math.max(EDGE.left, ...rows.map((name) => CHART.letter * name.length + 8));
  const [right, top, bottom] = [width - EDGE.right, EDGE.top, height - EDGE.bottom - (xlabel === undefined ? 0 : CHART.label)];
  const share = (value, [low, high]) => Math.min(Math.max((value - low) / (high - low), 0), 1);
  const toX = (value) => left + share(value, x) * (right - left);
  const toY = (value) => bottom - share(value, y) * (bottom - top);
  const ticks = rows.length ? rows.map((_, row) => row) : roundTicks(y[0], y[1], 4);
  for (const value of ticks) {
    const at = toY(value);
    draw(svg, "line", { x1: left, x2: right, y1: at, y2: at, stroke: "currentColor", opacity: value || rows.length ? 0.18 : 0.6 });
    draw(svg, "text", { x: left - 6, y: at + 4, "text-anchor": "end" }, rows[value] ?? short(value));
  }
  const seconds = xlabel === undefined ? " s" : "";
  for (const [k, value] of roundTicks(x[0], x[1], right - left > 340 ? 6 : 3).entries()) {
    draw(svg, "text", { x: toX(value), y: bottom + 17, "text-anchor": k ? "middle" : "start" }, `${short(value)}${k ? "" : seconds}`);
  }
  draw(svg, "text", { x: right, y: bottom + 33, "text-anchor": "end" }, xlabel ?? "");
  return { toX, toY, left, right, top, bottom };
}

/** List a curve in a legend: the element for its current number. */
export function drawKey(parent, name, color, dash = "") {
  const item = create(parent, "li");
  const swatch = draw(item, "svg", { width: 26, height: 8, "aria-hidden": true });
  draw(swatch, "line", { x2: 26, y1: 4, y2: 4, stroke: color, "stroke-width": 3, "stroke-dasharray": dash });
  create(item, "span", { textContent: name });
  return create(item, "b");
}

/** Charts of which the page holds the curves of all positions. */
export class Charts {
  constructor(figure, data) {
    Object.assign(this, { figure, data, pictures: 0 });
    addKnobs(this, () => this.show());
    this.figure.addEventListener("keydown", (event) => event.stopPropagation()); // so that the notebook does not handle the key
    this.body = create(figure, "div", { className: "motion-charts" });
    new ResizeObserver(() => this.show()).observe(figure);
  }

  /** Draw the charts of the current position. */
  show() {
    const { data, figure, picked, knobs, body } = this;
    let at = 0;
    data.choices.forEach(({ options }, k) => { at = at * options.length + options.indexOf(picked[k]); });
    for (const { name, low, high, step } of data.knobs) {
      at = at * (Math.round((high - low) / step) + 1) + Math.round((knobs[name] - low) / step);
    }
    const charts = data.frames[at].map(([axes, ...curves]) => ({ ...data.axes[axes], curves: curves.map((number) => data.curves[number]) }));
    const columns = Math.max(1, Math.min(charts.length, Math.floor(figure.clientWidth / CHART.column)));
    body.replaceChildren();
    for (const chart of charts) this.drawChart(chart, Math.floor(figure.clientWidth / columns) - 8);
    this.pictures++;
  }

  drawChart(chart, width) {
    const box = create(this.body, "div");
    box.style.width = `${width}px`;
    if (chart.title) create(box, "p", { className: "motion-title", textContent: chart.title });
    const key = create(box, "ul", { className: "motion-now" });
    create(key, "li", { textContent: chart.ylabel });
    const height = chart.rows.length ? CHART.row * chart.rows.length + 50 : CHART.plain;
    const words = [...chart.rows, ...chart.curves.flatMap(({ name, notes }) => [name, ...notes])].filter(Boolean);
    const svg = draw(box, "svg", { width, height, role: "img" });
    svg.setAttribute("aria-label", `${chart.title} ${chart.ylabel} against ${chart.xlabel}: ${words.join(", ")}`);
    const { toX, toY, right } = drawAxes(svg, { ...chart, width, height });
    const write = (note, at, y) => note && (at < right - CHART.note ? draw(svg, "text", { x: at + 8, y }, note)
      : draw(svg, "text", { x: at - 8, y, "text-anchor": "end" }, note));
    for (const { name, x, y, style, color, notes } of chart.curves) {
      const stroke = color === null ? "currentColor" : this.data.colors[color];
      const dots = style === "dots";
      const path = y.map((value, k) => (value === null ? ""
        : `${dots || (y[k - 1] ?? null) === null ? "M" : "L"}${toX(x[k]).toFixed(1)} ${toY(value).toFixed(1)}${dots ? "h0" : ""}`));
      const look = { stroke, "stroke-linecap": dots ? (color % 2 ? "square" : "round") : "butt", ...STYLES[style] };
      draw(svg, "path", { fill: stroke, ...look, d: path.join("") });
      notes.forEach((note, k) => write(note, toX(x[k]), toY(y[k]) + (chart.rows.length ? 4 : -6)));
      if (name) drawKey(key, name, stroke, look["stroke-dasharray"]);
    }
  }
}
