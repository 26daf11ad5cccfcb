// The wizard: which entries are the signals that were not found by name.

import { drawing, figure, make } from "./elements.js";
import { activate, load, shownLog } from "./logs.js";
import { at, guarded } from "./page.js";

const ROLES = [ // role, words, whether its entry holds texts, and what is taken if the log has no such entry
  ["voltage", "Voltage at the motor", false],
  ["position", "Position", false],
  ["velocity", "Velocity", false, "The slope of the position"],
  ["state", "Name of the running test", true],
  ["time", "Time, in seconds", false],
];
const MOST = 60; // candidates listed at a time

let role = "voltage"; // whose candidates are listed

/** Show the choices of a log: a button for each role, and the candidates of one role. */
export function showChoice() {
  const { name, runs, choice: { why, columns, chosen, entries } } = shownLog();
  at("choose-why").textContent = `${name}: ${why}`;
  at("choose-back").hidden = !runs;
  role = "voltage";
  // A column has to be chosen, even if its name is likely.
  for (const [one] of columns ? ROLES : []) if (unchosen(one) === "Found by its name") chosen[one] ??= entries.find(({ signal }) => signal === one).name;
  at("roles").replaceChildren(...ROLES.filter(([one]) => one !== "time" || columns).map(([value, words]) => {
    const onchange = () => { role = value; showCandidates(); };
    return make("label", "", make("input", { type: "radio", name: "role", value, checked: value === role, onchange }), words, make("span"));
  }));
  at("entry-filter").value = "";
  showCandidates();
}

/** The candidates for a role that the filter lets pass, our own guesses first. */
function showCandidates() {
  const { entries, chosen } = shownLog().choice;
  const [, words, isText] = ROLES.find(([one]) => one === role);
  showChosen();
  const parts = at("entry-filter").value.toLowerCase().split(/\s+/);
  const fitting = entries
    .filter((one) => one.text === isText && parts.every((part) => one.name.toLowerCase().includes(part)))
    .sort((a, b) => rank(a, chosen) - rank(b, chosen));
  const rows = fitting.slice(0, MOST).map((one) => candidate(one.name, one, chosen));
  at("candidates").setAttribute("aria-label", words);
  at("candidates").replaceChildren(candidate(unchosen(role), { name: "" }, chosen), ...rows);
  at("candidates-more").textContent = fitting.length > MOST ? `${fitting.length - MOST} more. Type a part of the name above.` : "";
}

/** The chosen entry, then our own guesses, entries of unknown use, and those of another role. */
function rank({ name, signal }, chosen) {
  return name === chosen[role] ? 0 : signal === role ? 1 : signal ? 3 : 2;
}

function candidate(words, { name, unit, signal, text: isText, values, picture }, chosen) {
  const box = make("input", {
    type: "radio", name: "entry", checked: (chosen[role] ?? "") === name, onchange: () => { chosen[role] = name; showChosen(); },
  });
  return make("label", "candidate", box, make("span", "name", words), make("span", "quiet", unit),
    name && signal === role && make("span", "badge", "likely"),
    name && (isText ? make("span", "spark", `${values} times`) : sparkline(picture)));
}

function showChosen() {
  const { chosen, columns, entries } = shownLog().choice;
  const slope = !chosen.velocity && unchosen("velocity").startsWith("The slope"); // needs a position
  const needed = ["voltage", slope && "position", "state", columns && "time"];
  const missing = ROLES.filter(([one]) => needed.includes(one) && !chosen[one] && unchosen(one).endsWith("choose one"));
  const names = entries.some(({ text }) => text) ? "" : " This file has no names of tests, such as quasistatic-forward: add a column with them.";
  at("open-chosen").disabled = Boolean(missing.length);
  at("missing").textContent = missing.length ? `Still missing: ${missing.map(([, words]) => words).join("; ")}.${names}` : "";
  for (const one of at("roles").children) one.lastChild.textContent = chosen[one.control.value] || unchosen(one.control.value);
}

/** What is taken for a role if none is chosen: the entry with its name, else what can replace it. */
function unchosen(role) {
  const named = shownLog().choice.entries.filter(({ signal }) => signal === role).length;
  return named === 1 ? "Found by its name" : named ? `${named} likely: choose one` : ROLES.find(([name]) => name === role)[3] ?? "None found: choose one";
}

/** A small plot of an entry. */
function sparkline(values) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const points = values.map((value, k) => `${((200 * k) / Math.max(values.length - 1, 1)).toFixed(1)} ${(34 - (30 * (value - low)) / (high - low || 1)).toFixed(1)}`);
  const picture = drawing("0 0 200 38", `M${points.join("L")}`, `from ${figure(low)} to ${figure(high)}`);
  picture.setAttribute("preserveAspectRatio", "none");
  picture.setAttribute("class", "spark");
  return picture;
}

at("entry-filter").addEventListener("input", showCandidates);
at("choose-back").addEventListener("click", () => {
  shownLog().choice = null;
  activate(shownLog().id);
});
at("signals").addEventListener("submit", (event) => {
  event.preventDefault();
  const log = shownLog();
  log.query = { ...log.query, ...log.choice.chosen };
  guarded(log.name, () => load(log));
});
