// The dialog of feedback gains: for the gains of the log, for those of theory, or for typed ones.

import { ask } from "./api.js";
import { make, sentence } from "./elements.js";
import { shownLog, state } from "./logs.js";
import { at } from "./page.js";

const DIGITS = 5; // significant digits of the log's gains
const form = at("loop-form");
let unitsShown = "";

/** Open the dialog with the gains of the log that is shown, if there is one. */
export function openLoops() {
  if (!form.motor.length) {
    const { motors, presets } = state.view;
    form.motor.append(new Option("these numbers", ""), ...motors.map((one) => new Option(one)));
    form.preset.append(...Object.entries(presets).map(([value, name]) => new Option(name, value)));
  }
  const log = shownLog();
  if (log?.fit) {
    const known = { ...log.gains, ...log.fit.delays, type: log.fit.type, units: log.summary.units.name, motor: "" };
    for (const [name, value] of Object.entries(known)) form[name].value = typeof value === "number" ? Number(value.toPrecision(DIGITS)) : value;
  }
  unitsShown = form.units.value;
  at("loops").showModal();
  showLoops();
}

/** Ask for the feedback gains of what the form holds, and show them. */
async function showLoops() {
  const query = Object.fromEntries([...new FormData(form)].map(([name, value]) => [name, value.replace(",", ".")]));
  const asked = (showLoops.asked = {}); // an answer to an older request is not shown
  const before = query.units === unitsShown ? "" : unitsShown; // then the gains are converted
  at("loop-parts").hidden = !query.motor;
  try {
    const { gains, rows, symbol } = await ask(`feedback?${new URLSearchParams({ ...query, before })}`);
    if (showLoops.asked !== asked) return;
    unitsShown = query.units;
    if (query.motor || before) for (const name of ["kV", "kA", "velocity_error", "position_error"]) if (name in gains) form[name].value = Number(gains[name].toPrecision(DIGITS));
    for (const one of form.querySelectorAll("i")) one.textContent = symbol;
    const shown = rows.map(({ loop, gains: words, step, instead }) => [make("dt", "", `${loop} loop`),
      make("dd", "", make("b", "", words), make("p", "", step), instead && make("p", "look", instead))]);
    const why = query.motor && !query.load ? "Type the mass or the inertia, for kA." : "There are none: kV and kA have to be above zero.";
    at("loop-gains").replaceChildren(...rows.length ? shown.flat() : [make("dd", "", why)]);
  } catch (problem) {
    if (showLoops.asked === asked) at("loop-gains").replaceChildren(make("dd", "advice", sentence(problem)));
  }
}

form.addEventListener("input", showLoops);
form.addEventListener("submit", (event) => event.preventDefault());
