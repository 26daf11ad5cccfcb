// The gains: a slider and a number for each, with the fit's own value and its error marked.

import { make } from "./elements.js";

const STEPS = 2000; // steps of a slider
const MOST_DECIMALS = 9;
const DIGITS = 5; // significant digits of a gain; small gains have fewer, to fit the field

/** Rows of sliders in a form; calls a function with {kS: 0.2, …} whenever a gain changes. */
export class Sliders {
  constructor(form, onMove) {
    this.form = form;
    this.onMove = onMove;
    this.rows = [];
    form.addEventListener("submit", (event) => event.preventDefault());
  }

  /** Show the gains of a fit: {name, value, error, unit, means}, at these values.
   *
   * Fixed gains are those of a model that the page cannot simulate.
   */
  show(gains, values, { fixed = false } = {}) {
    this.rows = gains.map((gain) => this.makeRow(gain, values[gain.name]));
    this.form.inert = fixed;
    this.form.title = fixed ? "The sliders rest while effects are in the model. Untick them to move the gains." : "";
    this.form.classList.toggle("fixed", fixed);
    this.form.replaceChildren(...this.rows.map((row) => row.place));
  }

  get values() {
    return Object.fromEntries(this.rows.map((row) => [row.gain.name, row.value]));
  }

  /** Whether a gain differs from that of the fit. */
  get isMoved() {
    return this.rows.some((row) => row.value !== row.gain.value);
  }

  makeRow(gain, value) {
    const [low, high] = endsOf(gain);
    const [id, name] = [`gain-${gain.name}`, gain.label];
    const number = make("input", { className: "number", type: "text", inputMode: "decimal", spellcheck: false, "aria-label": `${name} as a number` });
    const slider = make("input", { id, className: "slider", type: "range", min: low, max: high, step: (high - low) / STEPS, "aria-describedby": `${id}-means` });
    const place = make("div", "gain",
      make("div", "top", make("label", { className: "name", htmlFor: id, title: gain.means }, name), number,
        make("span", { className: "error", title: "one standard error" }, `± ${gain.error_text}`), make("span", "unit", gain.unit)),
      slider, make("p", { id: `${id}-means`, className: "means", title: gain.means }, gain.means));
    const share = (one) => Math.min(Math.max((one - low) / (high - low), 0), 1);
    slider.style.setProperty("--fit", share(gain.value));
    const row = { gain, value, place };
    row.put = (to, { typed = false } = {}) => {
      row.value = to;
      slider.value = to;
      slider.style.setProperty("--at", share(to));
      if (!typed) number.value = rounded(to, gain.error);
      slider.setAttribute("aria-valuetext", `${rounded(to, gain.error)} ${gain.unit}`);
      place.classList.toggle("moved", to !== gain.value);
    };
    const move = (to, how) => { row.put(to, how); this.onMove(this.values); };
    slider.oninput = () => move(Number(slider.value));
    slider.ondblclick = () => move(gain.value);
    number.oninput = () => {
      const typed = Number(number.value.replace("−", "-").replace(",", "."));
      const fine = number.value.trim() !== "" && Number.isFinite(typed);
      number.toggleAttribute("aria-invalid", !fine);
      if (fine) move(typed, { typed: true });
    };
    number.onblur = () => { number.removeAttribute("aria-invalid"); number.value = rounded(row.value, gain.error); };
    row.put(value);
    return row;
  }

  /** Set every gain to that of the fit. */
  reset() {
    for (const row of this.rows) row.put(row.gain.value);
    this.onMove(this.values);
  }
}

/** The range of the slider of a gain. */
function endsOf({ name, value }) {
  if (name === "kS") return [Math.min(0, 2 * value), Math.max(2 * value, 0.6)];
  if (name === "kG") return [value - Math.max(Math.abs(value), 0.5), value + Math.max(Math.abs(value), 0.5)];
  if (name === "offset_rad") return [value - 0.8, value + 0.8];
  return value > 0 ? [0.02 * value, 2 * value] : [2 * value, Math.max(-0.5 * value, 0.1)];
}

/** A gain rounded to the precision of its error, and to the width of the field. */
function rounded(value, error) {
  const digits = Math.abs(value) < 0.01 ? DIGITS - 2 : DIGITS;
  const most = value ? digits - 1 - Math.floor(Math.log10(Math.abs(value))) : digits;
  const needed = error > 0 ? 1 - Math.floor(Math.log10(error)) : MOST_DECIMALS;
  return value.toFixed(Math.min(Math.max(needed, 0), Math.max(most, 0), MOST_DECIMALS)).replace("-", "−");
}
