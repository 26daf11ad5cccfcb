// The verdict and its warnings, and the faults of the log.

import { button, foldedItem, make, prose } from "./elements.js";
import { choose, leaveOut, shownLog } from "./logs.js";
import { at } from "./page.js";
import { chart, listMarks } from "./stage.js";

const MOST_SHOWN = 12; // faults in the list; further ones are collapsed
const MOST_LINES = 3; // faults named under the verdict

export function showFaults() {
  const log = shownLog();
  const place = at("faults");
  if (!log.faults) {
    for (const one of [place, at("fault-lines")]) one.replaceChildren(make("li", "busy", "Looking for faults…"));
    return;
  }
  chart.mark({ faults: listMarks(log) });
  const { faults } = log.faults;
  const rows = faults.slice(0, MOST_SHOWN).map((one) => faultCard(log, one));
  if (faults.length > MOST_SHOWN) rows.push(make("li", "busy", `${faults.length - MOST_SHOWN} more are marked on the time axis.`));
  const none = log.faults.refused ? "Not inspected." : `No fault in ${log.runs.length === 1 ? "this run" : `these ${log.runs.length} runs`}.`;
  place.replaceChildren(...rows.length ? rows : [make("li", log.faults.refused ? "busy" : "well", none)]);
  const left = faults.filter((one) => !isLeftOut(log, one));
  const lines = left.slice(0, MOST_LINES).map((one) => {
    const words = `${titleOf(log, one)} (${one.sureness})${one.test ? `: ${nameOfTest(log, one)}` : ""}`;
    return make("li", "grave", button("link", words, () => showFault(one)), canLeaveOut(log, one) && make("span", "leave", " · ", leaveButton(log, one, "link")));
  });
  if (left.length > MOST_LINES) lines.push(make("li", "busy", button("link", `${left.length - MOST_LINES} more below`, () => at("faults").scrollIntoView({ behavior: "smooth" }))));
  at("fault-lines").replaceChildren(...faults.length || log.faults.refused ? lines : [make("li", "well", none)], ...leftOutLines(log));
  showDoubts();
}

/** Show where a fault is on the time axis; one without a place, its card. */
function showFault(one) {
  if (isPlaced(one)) chart.showFault({ run: one.run, start: one.start_s, end: one.end_s });
  at(isPlaced(one) ? "plot" : "faults").scrollIntoView({ block: "center", behavior: "smooth" });
}

/** The name of a fault, after the number that marks it in the chart. */
const titleOf = (log, one) => `${log.faults.faults.indexOf(one) + 1} ${one.fault.replaceAll("-", " ")}`;
const nameOfTest = (log, { run, test }) => `${log.runs[run]?.part ?? ""} ${test}`.trim();
const partOf = (one) => ({ test: one.test, start: one.start_s, end: one.end_s });

/** Whether nearly all of a fault is left out; its ends may be marked a little off. */
const isLeftOut = ({ leftOut }, one) => leftOut.some(({ test, start, end }) => test === one.test && Math.min(end, one.end_s) - Math.max(start, one.start_s) >= 0.9 * (one.end_s - one.start_s));

function faultCard(log, one) {
  const where = one.run === null ? one.test : `${nameOfTest(log, one)}, ${one.start_s.toFixed(2)} to ${one.end_s.toFixed(2)} s`;
  return make("li", "fault",
    make("h3", "", titleOf(log, one), make("span", "badge", one.sureness)),
    one.test && make("p", "where", where),
    make("p", "", prose(one.evidence)), make("p", "advice", prose(one.advice)),
    isPlaced(one) && [button("button small", "Show", () => showFault(one)), " ",
      canLeaveOut(log, one) ? leaveButton(log, one, "button small") : make("span", "quiet leave", "It is most of this test: record the test again.")]);
}

const isPlaced = (one) => one.test && one.run !== null;
/** Whether most of a test is left without a fault, or the fault is left out already. */
const canLeaveOut = (log, one) => isPlaced(one) && (isLeftOut(log, one) || log.runs[one.run].time.at(-1) - log.runs[one.run].time[0] > 2 * (one.end_s - one.start_s));

function leaveButton(log, one, kind) {
  const out = isLeftOut(log, one);
  return button(`${kind} leave`, out ? "Left out" : "Leave out", () => leaveOut(log, [...log.leftOut, partOf(one)]), { disabled: out });
}

/** A line for each part that was left out, with a button to take it in again. */
function leftOutLines(log) {
  const parts = [...new Set(log.runs.map(({ part }) => part))].filter(Boolean);
  const of = parts.length ? ` of ${parts.join(" and ")}` : "";
  return log.leftOut.map((part) => make("li", "busy", `Left out: ${part.test}${of}, ${part.start.toFixed(2)} to ${part.end.toFixed(2)}\u00a0s of the log · `,
    button("link leave", "Take in again", () => leaveOut(log, log.leftOut.filter((one) => one !== part)))));
}

/** The verdict in a word, and the warnings of fit and inspection, a line for each kind, the worst first. */
export function showDoubts() {
  const log = shownLog();
  const { fit, fitRefused, faults } = log;
  const sure = faults?.faults.some((one) => one.sureness === "sure" && !isLeftOut(log, one));
  const moved = fit?.gains.filter(({ name, value }) => log.gains[name] !== value).length;
  const word = moved ? "Moved by hand" : fitRefused ? "No gains" : !fit ? "Fitting…" : !faults ? "Checking…" : sure && ["Usable", "Partly usable"].includes(fit.word) ? "Check first" : fit.word;
  const bad = ["Not usable", "Do not use"].includes(word);
  at("word").textContent = word;
  if (fit) at("verdict").replaceChildren(...prose(moved ? "A gain that you moved is not measured. Reset it to see the verdict." : fit.verdict));
  at("verdict-card").classList.toggle("wrong", Boolean(fitRefused) || bad);
  at("verdict-card").classList.toggle("well", word === "Usable");
  at("paste").classList.toggle("primary", !bad);
  const said = [...fit?.doubts ?? [], ...faults?.doubts.filter((one) => !fit?.doubts.some(({ code }) => code === one.code)) ?? []].filter(({ code }) => !faults?.faults.some(({ fault }) => fault === code)).sort((a, b) => Number(b.grave) - Number(a.grave));
  const known = [...Map.groupBy(said, ({ code }) => code).values()].map((alike) =>
    ({ ...alike[0], message: [...new Set(alike.map(({ message }) => message))].join(" ") }));
  const notes = (fit?.notes ?? []).map((note) => foldedItem("well", "Note", note));
  const parts = fit?.parts.length
    ? [foldedItem("busy", "Note", `The fit also allows for ${fit.parts.join(", ")}; the curve here leaves them out.`)]
    : [];
  const open = [...at("doubts").querySelectorAll("[open] > summary")].map((one) => one.textContent);
  at("doubts").replaceChildren(...known.map((one) => doubtItem(log, one)), ...parts, ...notes);
  for (const one of at("doubts").querySelectorAll("details")) one.open = open.includes(one.firstChild.textContent);
}

function doubtItem(log, { message, grave, advice, type }) {
  return foldedItem(grave ? "grave" : "look", grave ? "Wrong" : "Warning", `${message} ${advice ?? ""}`,
    type && button("button small", `Fit as ${type}`, () => choose(log, "type", type)));
}
