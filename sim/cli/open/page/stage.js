// The card of the chart: the log's name, its runs, the values at the cursor, marked spans, other logs.

import { askLog, saved } from "./api.js";
import { Chart } from "./chart.js";
import { button, figure, make } from "./elements.js";
import { nameOfRun } from "./frame.js";
import { isAlike, leaveOut, logs, shownLog, state, takeEntry } from "./logs.js";
import { at, copy, guarded, say } from "./page.js";
import { writeSpans } from "./spans.js";

const OTHERS = ["#9b5de5", "#c08a00", "#2a9d8f", "#d0539a"]; // colors of other logs

export const chart = new Chart(at("still"), at("moving"), { onCursor: showCursor, onSpans: showSpans });

export function showStage() {
  const log = shownLog();
  const { summary } = log;
  at("title").textContent = log.name;
  const runs = `${log.runs.length} run${log.runs.length === 1 ? "" : "s"}`;
  const facts = [runs, `${summary.samples.toLocaleString("en")} samples`];
  if (summary.mechanism) facts.unshift(summary.mechanism);
  at("facts").textContent = facts.join(" · ");
  at("type").value = log.query.type ?? summary.type;
  at("units").value = summary.units.name;
  at("rechoose").hidden = !["voltage", "position", "velocity", "state", "time"].some((role) => log.query[role]);
  chart.setLog({ runs: log.runs, faults: listMarks(log), symbol: summary.units.symbol, entry: log.entry });
  if (chart.showsSignals) showSignals(true);
  showRuns(log);
  showCursor(null);
  showSpans(chart.spans);
  showOthers();
}

/** Show a log that is still being read. */
export function showReading(log) {
  at("title").textContent = log?.name ?? "";
  at("facts").textContent = "Reading…";
}

function showRuns(log) {
  const chips = log.runs.map((run, k) =>
    button("chip", nameOfRun(run), () => chart.showRun(k), { "aria-label": `Show run ${k}, ${run.part} ${run.test}` }));
  at("runs").replaceChildren(button("chip all", "All", () => chart.showAll()), ...chips);
}

/** The faults that have a place on the time axis, and the parts that were left out. */
export function listMarks(log) {
  const faults = (log.faults?.faults ?? []).map((one, k) => ({ ...one, start: one.start_s, end: one.end_s, number: `${k + 1}`, color: "fault" }))
    .filter(({ run, test }) => run !== null && test);
  const left = log.leftOut.flatMap(({ test, start, end }) => log.runs.flatMap(({ test: of, time }, run) =>
    (of === test && time.at(-1) >= start && time[0] <= end ? [{ run, start: Math.max(start, time[0]), end: Math.min(end, time.at(-1)), color: "quiet" }] : [])));
  return [...left, ...faults].sort((one, other) => one.run - other.run || one.start - other.start);
}

/** Show the signals of a log, or its fit. */
export function showSignals(on) {
  chart.showSignals(on);
  document.body.classList.toggle("signals", on);
  document.querySelector(`#views [value=${on ? "signals" : "fit"}]`).checked = true;
  showCursor(chart.cursor);
  showSpans(chart.spans);
  if (on) offerEntries(shownLog());
}

/** List the numbers of a log that can be plotted beside its signals. */
async function offerEntries(log) {
  at("entry").hidden = true;
  if (!log?.runs || saved) return;
  log.entries ??= await askLog(log.id, "entries").catch(() => []);
  const names = log.entries.filter((one) => !one.text).map(({ name }) => name);
  if (log !== shownLog()) return;
  at("entry").hidden = !names.length;
  at("entry").value = log.entry ?? "";
  at("entries").replaceChildren(...names.map((one) => new Option(one)));
}

/** Show the text of the marked spans. */
function showSpans(spans) {
  const log = shownLog();
  if (!log?.runs) return;
  const { raw, span_text: pattern } = state.view;
  const words = writeSpans(pattern, log, spans);
  at("span-text").textContent = words;
  at("span-text").hidden = at("span-copy").hidden = at("span-clear").hidden = !words;
  at("span-leave").hidden = !words || raw;
  at("span-hint").textContent = words ? pattern.hint : "Drag across a test to mark a part of it. Then you can copy its times from here.";
}

/** Show the run, the times and the values of all curves at the cursor. */
export function showCursor(cursor) {
  const log = shownLog();
  if (!log?.runs) return;
  const run = cursor && log.runs[cursor.run];
  const seconds = (since) => (run ? `${(run.time[cursor.sample] - since).toFixed(3)} s` : "–");
  const times = chart.showsSignals
    ? [["time in the test", seconds(run?.time[0])], ["time in the log", seconds(0)]] : [["time", seconds(0)]];
  const values = chart.shown.curves.filter(({ label }) => label).map(({ label, of, unit, color }) => {
    const one = run && of(chart, cursor.run);
    const value = one?.values[cursor.sample - one.first];
    return [`${label}, ${unit(chart)}`, Number.isFinite(value) ? figure(value) : "–", color];
  });
  const rows = [["run", run ? run.test : "point at the curve", "run"], ...times, ...values];
  at("readout").replaceChildren(...rows.map(([name, value, kind = ""]) => make("div", kind, make("dt", "", name), make("dd", "", value))));
}

/** Draw the runs of other logs over those of the same test, in their order. */
export function showOthers() {
  const log = shownLog();
  if (!log?.runs) return;
  const laid = [];
  const others = [...logs.values()].filter((one) => one.others && one !== log && isAlike(one, log));
  for (const [k, other] of others.entries()) {
    const used = new Set();
    for (const [run, mine] of log.runs.entries()) {
      const theirs = other.runs.find((one) => one.test === mine.test && !used.has(one));
      if (!theirs) continue;
      used.add(theirs);
      const factor = other.summary.units.si / log.summary.units.si;
      laid.push({ color: OTHERS[k % OTHERS.length], run, time: theirs.time, velocity: theirs.velocity.map((value) => value * factor) });
    }
  }
  chart.mark({ others: laid });
  document.querySelector(".legend .other").hidden = !others.length;
}

at("views").addEventListener("change", ({ target }) => showSignals(target.value === "signals"));
at("entry").addEventListener("change", () => guarded("signal", async () => {
  const log = shownLog();
  await takeEntry(log, at("entry").value);
  chart.entry = log.entry;
  showSignals(true);
}));
at("drag").addEventListener("change", ({ target }) => { chart.dragMarks = target.value === "mark"; });
at("span-copy").addEventListener("click", () => copy(at("span-text")));
at("span-leave").addEventListener("click", () => {
  const log = shownLog();
  const marked = [...chart.spans].map(([run, [first, last]]) => ({ test: log.runs[run].test, start: log.runs[run].time[first], end: log.runs[run].time[last] }));
  leaveOut(log, [...log.leftOut, ...marked]);
  at("span-clear").click();
  say("Left out. The gains are those of the rest.");
});
at("span-clear").addEventListener("click", () => { for (const run of [...chart.spans.keys()]) chart.setSpan(run, null); });
