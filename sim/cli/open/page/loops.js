// The dialog of feedback gains: for the gains of the log, for those of theory, or for typed ones.

import { ask } from "./api.js";
import { figure, make, prose, sentence } from "./elements.js";
import { shownLog, state } from "./logs.js";
import { at } from "./page.js";

const DIGITS = 5; // significant digits of the log's gains
const form = at("loop-form");

/** Open the dialog with the gains of the log that is shown, if there is one. */
export function openLoops() {
  if (!form.motor.length) {
    const { motors, presets } = state.view;
    form.motor.append(new Option("typed gains", ""), ...motors.map((one) => new Option(one)));
    form.preset.append(...Object.entries(presets).map(([value, name]) => new Option(name, value)));
  }
  const log = shownLog();
  if (log?.fit) {
    const known = { ...log.gains, ...log.fit.delays, type: log.fit.type, units: log.summary.units.name, motor: "" };
    for (const [name, value] of Object.entries(known)) form[name].value = typeof value === "number" ? Number(value.toPrecision(DIGITS)) : value;
  }
  at("loops").showModal();
  showLoops();
}

/** Ask for the feedback gains of what the form holds, and show them. */
async function showLoops() {
  const query = Object.fromEntries([...new FormData(form)].map(([name, value]) => [name, value.replace(",", ".")]));
  at("loop-parts").hidden = !query.motor;
  try {
    const { gains, rows, doubts, symbol } = await ask(`feedback?${new URLSearchParams(query)}`);
    if (query.motor) for (const name of ["kV", "kA"]) form[name].value = figure(gains[name]);
    for (const one of form.querySelectorAll("i")) one.textContent = symbol;
    const shown = rows.map(({ loop, gains: words, step }) => [
      make("dt", "", `${loop} loop`), make("dd", "", words.join("\n")), make("dd", "quiet", `In simulation, it ${step}.`)]);
    const none = [make("dd", "quiet", "There are none: kV and kA have to be above zero.")];
    at("loop-gains").replaceChildren(...rows.length ? shown.flat() : none, ...doubts.map((one) => make("dd", "advice", prose(one))));
  } catch (problem) {
    at("loop-gains").replaceChildren(make("dd", "advice", sentence(problem)));
  }
}

form.addEventListener("input", showLoops);
form.addEventListener("submit", (event) => event.preventDefault());
