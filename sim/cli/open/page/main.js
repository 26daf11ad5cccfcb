// The page: the open logs, the selected log, and its results.

import {
  Refused, addressOf, askLive, askLog, askSamples, askView, closeLog, listLogs, openExample, openFile, saved, stopSearch,
} from "./api.js";
import { Chart } from "./chart.js";
import { makeSignalRows } from "./choices.js";
import { button, figure, foldedItem, item, prose, sentence, text } from "./elements.js";
import { makeModel, rms, simulateRun } from "./simulate.js";
import { Sliders } from "./sliders.js";
import { writeSpans } from "./spans.js";
import { searchForm, storyParts } from "./story.js";

const MOST_SHOWN = 12; // faults in the list; further ones are collapsed
const MOST_LINES = 3; // faults named under the verdict
const FINEST = 1000; // times of a part to leave out are rounded to 1/FINEST s
const SIGNALS = 4; // arrays of a run: time, voltage, position, velocity

const at = (id) => document.getElementById(id);
const logs = new Map();
const begun = new Set(); // numbers of the logs that are or were open
let active = null;
let view = { raw: false, span_text: {} }; // the PageView of the server

const chart = new Chart(at("still"), at("moving"), { onCursor: showCursor, onSpans: showSpans });
const sliders = new Sliders(at("sliders"), moveGains);
window.sysid = { chart, sliders, logs, begin }; // for tests and for debugging

// ---- opening logs

async function openAll(files) {
  await Promise.all([...files].map(async (file) => {
    await guarded(file.name, async () => begin(await openFile(file)));
  }));
}

/** Add a log that the server opened: read it, show it, then request faults and gains.
 *
 * A log that is dropped while the page requests the open logs is named twice, but added once.
 */
async function begin({ id, name, revision = 0 }) {
  if (begun.has(id)) return;
  begun.add(id);
  const log = { id, name, revision, query: {}, others: false, leftOut: [] };
  logs.set(id, log);
  if (active === null) activate(id);
  showTabs();
  await load(log);
}

async function load(log) {
  log.failed = null;
  log.faults = log.fit = log.fitRefused = log.search = null;
  log.effects = [];
  const asked = (log.asked = {});
  setLoading(log, true);
  try {
    const [summary, samples] = await Promise.all([
      askLog(log.id, "summary", log.query),
      askSamples(log.id, log.query),
    ]);
    if (log.asked !== asked) return;
    take(log, summary, samples);
  } catch (problem) {
    setLoading(log, false);
    if (await offerChoice(log, problem)) return;
    forget(log.id);
    throw problem;
  }
  log.choice = null;
  if (active === log.id) activate(log.id);
  showTabs();
  if (!view.raw) await Promise.all([askFaults(log, asked), askFit(log, asked)]);
  setLoading(log, false);
  if (saved && `logs/${log.id}/reconcile` in saved) await reconcile(log, {});
}

/** Split the samples into runs; positions and velocities in the log's unit, times in seconds. */
function take(log, summary, samples) {
  log.summary = summary;
  let from = 0;
  const next = (count) => samples.subarray(from, (from += count));
  log.runs = summary.runs.map((run) => {
    const [time, voltage, position, velocity] = Array.from({ length: SIGNALS }, () => next(run.samples));
    const part = summary.runs.some((one) => one.part !== run.part) ? run.part : "";
    return { ...run, part, time, voltage, position: per(position, summary), velocity: per(velocity, summary) };
  });
  log.top = log.runs.reduce((top, run) => run.velocity.reduce((most, one) => Math.max(most, Math.abs(one)), top), 0);
}

function per(values, { units }) {
  return units.si === 1 ? values : values.map((value) => value / units.si);
}

async function askFaults(log, asked) {
  const found = await askLog(log.id, "faults", log.query).catch((problem) => ({
    faults: [], clean: false, doubts: [{ message: sentence(problem), grave: true }],
  }));
  if (log.asked !== asked) return;
  log.faults = found;
  if (active === log.id) showFaults();
}

async function askFit(log, asked) {
  try {
    const fit = await askLog(log.id, "fit", modelQuery(log));
    if (log.asked !== asked) return;
    log.plain = fit;
    takeFit(log, fit);
    log.plainSimulated = log.simulated;
    log.fitError = simulate(log, log.gains);
  } catch (problem) {
    if (!(problem instanceof Refused)) throw problem;
    log.fitRefused = problem;
  }
  if (active === log.id) showFit();
  if (!log.fit) return;
  const more = await askLog(log.id, "directions", modelQuery(log)).catch(() => null);
  if (more === null || log.asked !== asked) return;
  log.plain.doubts.push(...more.doubts);
  log.plain.notes.push(...more.notes);
  if (active === log.id) showDoubts();
}

/** Fit again without these parts: {test, start, end}, in the log's time. */
function leaveOut(log, parts) {
  Object.assign(log, { leftOut: parts, effects: [], fit: null, fitRefused: null, asked: {} });
  setLoading(log, true);
  showFaults();
  showFit();
  guarded(log.name, () => askFit(log, log.asked)).then(() => setLoading(log, false));
}

function nameOfPart({ test, start, end }) {
  return `${test}:${Math.floor(FINEST * start) / FINEST}-${Math.ceil(FINEST * end) / FINEST}`;
}

/** A line for each part that was left out, with a button to take it in again. */
function leftOutLines(log) {
  return log.leftOut.map((part) => {
    const line = item("busy", `Left out: ${part.test}, ${part.start.toFixed(2)} to ${part.end.toFixed(2)} s `);
    line.append(button("link", "Take in again", () => leaveOut(log, log.leftOut.filter((one) => one !== part))));
    return line;
  });
}

/** Show the gains of a fit, or of a model with effects. */
function takeFit(log, fit) {
  log.fit = fit;
  log.moved = false;
  log.gains = Object.fromEntries(fit.gains.map((gain) => [gain.name, gain.value]));
  simulate(log, log.gains);
}

/** Do something for one file; an error is shown, and the rest of the page keeps working. */
async function guarded(name, work) {
  try {
    await work();
  } catch (problem) {
    if (!(problem instanceof Refused)) console.error(problem);
    showRefusal(name, problem);
  }
}

function forget(id) {
  logs.delete(id);
  closeLog(id).catch(() => {});
  if (active === id) activate([...logs.keys()].at(-1) ?? null);
  showTabs();
}

// ---- logs that grow

const LOOK = 500; // [ms] between two requests for the status of sysid watch

/** Follow the logs of sysid watch: read a log again whenever a test in it has ended. */
async function followLive() {
  for (;;) {
    const live = await askLive();
    if (!live.follows) return;
    showLive(live);
    for (const { id, name, revision } of live.logs) {
      const log = logs.get(id);
      if (log?.revision === revision) continue;
      if (log) {
        log.revision = revision;
        await guarded(name, () => load(log));
      } else {
        await guarded(name, () => begin({ id, name, revision }));
        activate(id);
        showTabs();
      }
    }
    await new Promise((done) => setTimeout(done, LOOK));
  }
}

function showLive({ status, counts, next }) {
  at("live").hidden = false;
  at("empty").querySelector(".or").hidden = at("empty").querySelector(".primary").hidden = true;
  at("empty-title").textContent = "Waiting for the first test.";
  at("empty-lead").textContent = "Run the four tests in any order. The log appears here when one has ended.";
  at("live-status").textContent = status;
  const words = Object.entries(counts).map(([test, count]) => {
    const one = item(count ? "done" : "", `${test}${count > 1 ? ` (${count})` : ""}`);
    one.setAttribute("aria-label", `${test}: ${count ? `${count} recorded` : "missing"}`);
    return one;
  });
  at("live-tests").replaceChildren(...words);
  const said = at("live-next");
  if (said.dataset.said !== next) said.replaceChildren(...prose(next)); // only when it has changed
  said.dataset.said = next;
}

// ---- signals that are not found by name

/** If signals are missing and the file has entries, let the user choose; returns whether so. */
async function offerChoice(log, problem) {
  if (problem.kind !== "MissingSignal") return false;
  const entries = log.choice?.entries ?? await askLog(log.id, "entries").catch(() => []);
  if (!entries.length) return false;
  log.choice = { entries, why: `${problem.what}.`, chosen: { ...log.query } };
  if (active === log.id) activate(log.id);
  showTabs();
  return true;
}

function showChoice(log) {
  const { entries, why, chosen } = log.choice;
  at("choose-why").textContent = `${log.name}: ${why}`;
  at("signal-rows").replaceChildren(...makeSignalRows(entries, chosen));
}

at("signals").addEventListener("submit", (event) => {
  event.preventDefault();
  const log = logs.get(active);
  const chosen = Object.fromEntries(new FormData(event.target));
  log.query = { ...log.query, ...chosen };
  guarded(log.name, () => load(log));
});

// ---- simulating

/** Simulate every run of a log with gains in its unit; returns the error, sets curves in `log`. */
function simulate(log, gains) {
  const { si } = log.summary.units;
  const { tracks } = log.fit; // of a model with effects, which only the server simulates
  const inSi = { ...gains, kV: gains.kV / si, kA: gains.kA / si };
  const model = makeModel(log.fit.type, inSi, log.fit);
  let [sum, count] = [0, 0];
  log.simulated = log.runs.map((run, k) => {
    const start = log.fit.starts[k];
    if (!start || !(tracks ? tracks[k] : model)) return null;
    const cut = { time: run.time.subarray(start.first), voltage: run.voltage.subarray(start.first) };
    const velocity = tracks ? Float64Array.from(tracks[k].slice(start.first)) : simulateRun(cut, model, start).velocity;
    if (si !== 1) velocity.forEach((value, i) => { velocity[i] = value / si; });
    const error = rms(run.velocity.subarray(start.first), velocity);
    sum += error * error * velocity.length;
    count += velocity.length;
    return { first: start.first, velocity };
  });
  return count ? Math.sqrt(sum / count) : null;
}

function moveGains(values) {
  const log = logs.get(active);
  if (!log?.fit) return;
  log.gains = values;
  log.moved = sliders.isMoved;
  if (moveGains.waiting) return;
  moveGains.waiting = requestAnimationFrame(() => {
    moveGains.waiting = 0;
    showSimulation(log);
  });
}

function showSimulation(log) {
  if (active !== log.id) return;
  const error = simulate(log, log.gains);
  const without = log.fit.tracks ? log.plainSimulated : [];
  chart.setSimulation(log.simulated, log.fit.noise === null ? null : log.fit.noise / log.summary.units.si, without);
  document.querySelector(".legend .without").hidden = !without.length;
  showMeter(log, error);
  showCursor(chart.cursor);
  at("reset").hidden = !sliders.isMoved;
}

// ---- showing

function activate(id) {
  active = id;
  at("empty").hidden = id !== null;
  const choice = logs.get(id)?.choice;
  at("work").hidden = id === null || Boolean(choice);
  at("choose").hidden = !choice;
  if (choice) showChoice(logs.get(id));
  document.title = id === null ? "sysid" : `${logs.get(id).name} – sysid`;
  if (choice) return;
  if (logs.get(id)?.runs) showLog();
  else clear(logs.get(id));
}

/** Show a log that is still being read. */
function clear(log) {
  at("title").textContent = log?.name ?? "";
  at("facts").textContent = "Reading…";
  for (const id of ["runs", "faults", "fault-lines", "doubts", "feedback", "sliders", "word", "meter", "readout", "story"]) at(id).replaceChildren();
  at("verdict").textContent = "";
}

function showLog() {
  const log = logs.get(active);
  const { summary } = log;
  at("title").textContent = log.name;
  const runs = `${log.runs.length} run${log.runs.length === 1 ? "" : "s"}`;
  const facts = [runs, `${summary.samples.toLocaleString("en")} samples`];
  if (summary.mechanism) facts.unshift(summary.mechanism);
  at("facts").textContent = facts.join(" · ");
  at("type").value = log.query.type ?? summary.type;
  at("units").value = summary.units.name;
  chart.setLog({ runs: log.runs, faults: marks(log), symbol: summary.units.symbol });
  showRuns(log);
  showCursor(null);
  showSpans(chart.spans);
  showOthers();
  if (view.raw) return;
  showFaults();
  showFit();
  showStory();
  setLoading(log, !(log.faults && (log.fit || log.fitRefused)));
}

// ---- the signals alone

/** Show the signals of a log, or its fit. */
function showSignals(on) {
  chart.showSignals(on);
  document.body.classList.toggle("signals", on);
  for (const one of at("views").children) one.setAttribute("aria-pressed", String((one.value === "signals") === on));
  showCursor(chart.cursor);
  showSpans(chart.spans);
}

function setDrag(marks) {
  chart.dragMarks = marks;
  for (const one of at("drag").children) one.setAttribute("aria-pressed", String((one.value === "mark") === marks));
}

/** Show the text of the marked spans. */
function showSpans(spans) {
  const log = logs.get(active);
  if (!log?.runs) return;
  const words = writeSpans(view.span_text, log, spans);
  at("span-text").textContent = words;
  at("span-text").hidden = at("span-copy").hidden = at("span-clear").hidden = !words;
  at("span-leave").hidden = !words || view.raw;
  at("span-hint").textContent = words ? view.span_text.hint : "Drag across a test to mark a part of it. Its times then stand here, ready to copy.";
}

at("views").addEventListener("click", ({ target }) => { if (target.value) showSignals(target.value === "signals"); });
at("drag").addEventListener("click", ({ target }) => { if (target.value) setDrag(target.value === "mark"); });
at("span-copy").addEventListener("click", () => copy(at("span-text")));
at("span-leave").addEventListener("click", () => {
  const log = logs.get(active);
  const marked = [...chart.spans].map(([run, [first, last]]) => ({ test: log.runs[run].test, start: log.runs[run].time[first], end: log.runs[run].time[last] }));
  leaveOut(log, [...log.leftOut, ...marked]);
  say("Left out. The gains are those of the rest.");
});
at("span-clear").addEventListener("click", () => { for (const run of [...chart.spans.keys()]) chart.setSpan(run, null); });

function showRuns(log) {
  const chips = log.runs.map((run, k) => {
    const way = run.test.endsWith("forward") ? "→" : "←";
    const label = `${run.part ? `${run.part} ` : ""}${run.test.replace(/-\w+$/, "")} ${way}`;
    const chip = button("chip", label, () => chart.showRun(k));
    chip.setAttribute("aria-label", `Show run ${k}, ${run.part} ${run.test}`);
    return chip;
  });
  at("runs").replaceChildren(button("chip all", "All", () => chart.showAll()), ...chips);
}

function marks(log) {
  return (log.faults?.faults ?? [])
    .filter((one) => one.run !== null && one.test)
    .map((one) => ({ run: one.run, start: one.start_s, end: one.end_s, name: one.fault }));
}

function showFaults() {
  const log = logs.get(active);
  const place = at("faults");
  if (!log.faults) {
    for (const one of [place, at("fault-lines")]) one.replaceChildren(item("busy", "Looking for faults…"));
    return;
  }
  chart.setFaults(marks(log));
  const growing = log.revision > 0; // then a missing test is not a fault
  const faults = log.faults.faults.filter(({ fault }) => !(growing && fault === "missing-test"));
  const rows = faults.slice(0, MOST_SHOWN).map((one) => faultCard(one));
  if (faults.length > MOST_SHOWN) rows.push(item("busy", `${faults.length - MOST_SHOWN} more are marked on the time axis.`));
  const none = `No fault in ${log.runs.length === 1 ? "this run" : `these ${log.runs.length} runs`}.`;
  place.replaceChildren(...rows.length ? rows : [item("well", none)]);
  const lines = faults.slice(0, MOST_LINES).map((one) => {
    const line = item("grave");
    line.append(button("link", `${one.fault.replaceAll("-", " ")} (${surenessOf(one)})${one.test ? `: ${one.test}` : ""}`, () => showFault(one)));
    return line;
  });
  if (faults.length > MOST_LINES) lines.push(item("busy", `${faults.length - MOST_LINES} more below`));
  at("fault-lines").replaceChildren(...lines.length ? lines : [item("well", none)], ...leftOutLines(log));
  showDoubts();
}

function surenessOf({ confidence }) {
  return confidence >= 0.9 ? "sure" : confidence >= 0.7 ? "likely" : "perhaps";
}

/** Show where a fault is on the time axis; one without a place, its card. */
function showFault(one) {
  const placed = one.run !== null && one.test;
  if (placed) chart.showFault({ run: one.run, start: one.start_s, end: one.end_s });
  at(placed ? "plot" : "faults").scrollIntoView({ block: "center", behavior: "smooth" });
}

function faultCard(one) {
  const card = item("fault");
  const name = text("h3", one.fault.replaceAll("-", " "));
  name.append(text("span", surenessOf(one), "badge"));
  card.append(name);
  if (one.test) {
    const where = one.run === null ? one.test : `${one.test}, ${one.start_s.toFixed(2)} to ${one.end_s.toFixed(2)} s`;
    card.append(text("p", where, "where"));
  }
  const advice = text("p", "", "advice");
  advice.append(...prose(one.advice));
  card.append(text("p", one.evidence), advice);
  if (one.run !== null && one.test) {
    const log = logs.get(active);
    const part = { test: one.test, start: one.start_s, end: one.end_s };
    const leave = button("button small leave", "Leave out", () => leaveOut(log, [...log.leftOut, part]));
    leave.disabled = log.leftOut.some((other) => nameOfPart(other) === nameOfPart(part));
    card.append(button("button small", "Show", () => showFault(one)), " ", leave);
  }
  return card;
}

function showFit() {
  const log = logs.get(active);
  const { fit, fitRefused } = log;
  at("paste").disabled = !fit;
  at("reset").hidden = true;
  const report = at("report");
  report.toggleAttribute("href", false);
  report.setAttribute("aria-disabled", String(!fit));
  showDoubts();
  if (!fit) {
    for (const id of ["sliders", "meter", "feedback"]) at(id).replaceChildren();
    at("verdict").textContent = fitRefused ? sentence(fitRefused) : log.summary.compiles
      ? "The simulation is compiled first. That is done once, and takes about twenty seconds." : "";
    return;
  }
  report.href = addressOf(log.id, "report.html", modelQuery(log));
  report.download = `${log.name}.html`;
  sliders.show(fit.gains, log.gains, { fixed: Boolean(fit.tracks) });
  at("verdict").replaceChildren(...prose(fit.verdict));
  showFeedback(fit);
  showSimulation(log);
}

/** Feedback gains to start with, as SysId suggests them. */
function showFeedback({ feedback }) {
  const rows = Object.entries(feedback).map(([loop, { kP, kD }]) => {
    const pair = document.createElement("div");
    const gains = [`kP ${figure(kP)}`, ...(kD ? [`kD ${figure(kD)}`] : [])];
    pair.append(text("dt", `${loop} loop`), text("dd", gains.join("  ")));
    return pair;
  });
  at("feedback").replaceChildren(...rows);
}

/** The verdict in a word, and the warnings of fit and inspection, each once, the worst first. */
function showDoubts() {
  const { fit, fitRefused, faults } = logs.get(active);
  const sure = faults?.faults.some((one) => one.confidence >= 0.9);
  const word = fitRefused ? "No gains" : !fit ? "Fitting…" : sure && fit.word !== "Do not use" ? "Check first" : fit.word;
  at("word").textContent = word;
  at("verdict-card").classList.toggle("wrong", Boolean(fitRefused) || word === "Do not use");
  at("verdict-card").classList.toggle("well", word === "Usable");
  const said = new Map([...fit?.doubts ?? [], ...faults?.doubts ?? []].map((one) => [one.message, one]));
  const known = [...said.values()].sort((a, b) => Number(b.grave) - Number(a.grave));
  const notes = (fit?.notes ?? []).map((note) => foldedItem("well", "Note", note));
  const parts = fit?.parts.length
    ? [foldedItem("busy", "Note", `The fit also allows for ${fit.parts.map((one) => one.replaceAll("-", " ")).join(", ")}; the curve here leaves them out.`)]
    : [];
  const open = [...at("doubts").querySelectorAll("[open] > summary")].map((one) => one.textContent);
  at("doubts").replaceChildren(...known.map((one) => doubtItem(one)), ...parts, ...notes);
  for (const one of at("doubts").querySelectorAll("details")) one.open = open.includes(one.firstChild.textContent);
}

function doubtItem({ message, grave, advice, type }) {
  const made = foldedItem(grave ? "grave" : "look", grave ? "Wrong" : "Warning", `${message} ${advice ?? ""}`);
  if (type) made.firstChild.append(button("button small", `Fit as ${type}`, () => choose("type", type)));
  return made;
}

// ---- missing effects

const POLL = 250; // [ms] between two requests for the progress of a search

/** Search with these settings: {validation, held_out}: numbers of other logs; longer: try harder. */
async function reconcile(log, settings) {
  const { asked } = log;
  const search = (log.search = { words: "begins", share: 0, settings });
  if (log.effects.length) await chooseEffects(log, []);
  showStory();
  try {
    while (!search.story) {
      Object.assign(search, await askLog(log.id, "reconcile", { ...log.query, ...settings }));
      if (log.asked !== asked) return;
      if (active === log.id) showStory();
      if (!search.story) await new Promise((done) => setTimeout(done, POLL));
    }
    if (search.story.effects.length && log.plain) await chooseEffects(log, search.story.effects);
  } catch (problem) {
    if (log.asked !== asked) return;
    search.refused = sentence(problem);
    if (active === log.id) showStory();
  }
}

/** The query for data about the chosen model. */
function modelQuery(log) {
  return { ...log.query, ...log.search?.settings, effects: log.effects.join(), left_out: log.leftOut.map(nameOfPart).join() };
}

/** Show gains and curves of the model with these effects; without any, those of the fit. */
async function chooseEffects(log, effects) {
  const { asked, effects: before } = log;
  log.effects = effects;
  try {
    const fit = effects.length ? { ...log.plain, ...await askLog(log.id, "fit", modelQuery(log)) } : log.plain;
    if (log.asked !== asked || log.effects !== effects) return;
    takeFit(log, fit);
  } catch (problem) {
    log.effects = before;
    showStory();
    throw problem;
  }
  if (active !== log.id) return;
  showFit();
  showStory();
  showOthers();
}

function showStory() {
  const log = logs.get(active);
  const { search } = log;
  const place = at("story");
  if (search && !search.story && !search.refused) {
    const bar = place.querySelector("progress") ?? Object.assign(document.createElement("progress"), { max: 1 });
    bar.value = search.share;
    bar.setAttribute("aria-label", "How far the search is");
    const stop = place.querySelector(".stop") ?? button("button stop", "Stop", () => {
      search.stopped = true;
      stopSearch(log.id, { ...log.query, ...search.settings });
      showStory();
    });
    stop.disabled = search.stopped;
    place.replaceChildren(text("p", `${search.stopped ? "stopping after" : ""} ${search.words}…`, "quiet"), bar, stop);
    return;
  }
  const others = [...logs.values()].filter((one) => one !== log && one.runs);
  const parts = !search
    ? [text("p", "Tries every effect of the catalogue, drag to backlash, and names those that explain the simulation error. " + (log.summary.compiled
        ? "This takes some seconds." : "This takes minutes: Numba is not installed. With the extra fast it takes seconds."), "quiet")]
    : search.refused ? [item("grave", search.refused)]
      : storyParts(search.story, log, (effects) => guarded(log.name, () => chooseEffects(log, effects)));
  place.replaceChildren(...parts, searchForm(search, others, (settings) => guarded(log.name, () => reconcile(log, settings))));
}

function showMeter(log, error) {
  if (error === null) {
    at("meter").replaceChildren(text("p", "Nothing moves with these gains: kV and kA have to be above zero.", "quiet"));
    return;
  }
  const { si, symbol } = log.summary.units;
  const floors = (error * si) / log.fit.noise;
  const gap = text("p", "", "gap");
  gap.append(text("b", floors.toPrecision(floors < 10 ? 2 : 3)), " × sensor noise, ", text("b", (100 * error / log.top).toPrecision(2)), "\u00a0% of top speed");
  const ratio = error / log.fitError;
  const moved = log.moved ? `, ${ratio >= 10 ? Math.round(ratio) : ratio.toFixed(2)} × that of the fit` : "";
  const bar = text("div", "", "bar-of-error");
  bar.style.setProperty("--share", Math.min(1, Math.max(0.04, 1 / floors)));
  bar.classList.toggle("far", floors > 2);
  at("meter").replaceChildren(gap, text("p", `simulation error ${figure(error)} ${symbol}/s${moved}`, "quiet"), bar);
}

function showCursor(cursor) {
  const log = logs.get(active);
  if (!log?.runs) return;
  const { symbol } = log.summary.units;
  const run = cursor && log.runs[cursor.run];
  const k = cursor?.sample;
  const one = cursor && log.simulated?.[cursor.run];
  const guess = one && k >= one.first ? one.velocity[k - one.first] : undefined;
  const derived = run && chart.derived?.runs[cursor.run];
  const value = (number, unit) => (number === undefined ? "–" : `${figure(number)} ${unit}`);
  const time = ["time", run ? `${run.time[k].toFixed(3)} s` : "–", ""];
  const of = {
    run: ["run", run ? run.test : "point at the curve", "run"],
    volts: ["voltage", value(run?.voltage[k], "V"), "volts"],
    position: ["position", value(run?.position[k], symbol), chart.showsSignals ? "place" : ""],
    measured: [chart.showsSignals ? "velocity" : "measured", value(run?.velocity[k], `${symbol}/s`), "measured"],
  };
  const rows = chart.showsSignals
    ? [
        of.run,
        ["time in the test", run ? `${(run.time[k] - run.time[0]).toFixed(3)} s` : "–", ""],
        of.volts,
        of.measured,
        of.position,
        ["slope of position", value(derived?.slope[k], `${symbol}/s`), "place"],
        ["time step", run && k ? `${derived.step[k - 1].toFixed(1)} ms` : "–", ""],
        ["time in the log", time[1], ""],
      ]
    : [
        of.run, time, of.volts, of.measured,
        ["simulated", value(guess, `${symbol}/s`), "simulated"],
        ["error", value(guess === undefined ? undefined : run.velocity[k] - guess, `${symbol}/s`), "left"],
        of.position,
      ];
  at("readout").replaceChildren(...rows.map(([name, value, kind]) => {
    const pair = text("div", "", kind);
    pair.append(text("dt", name), text("dd", value));
    return pair;
  }));
}

function showTabs() {
  const tabs = [...logs.values()].map((log) => {
    const tab = text("div", "", `tab${log.id === active ? " now" : ""}`);
    const name = button("name", log.name, () => { activate(log.id); showTabs(); });
    if (log.id === active) name.setAttribute("aria-current", "true");
    tab.append(name);
    if (logs.size > 1 && log.id !== active) {
      const over = button("over", "◑", () => { log.others = !log.others; showOthers(); showTabs(); });
      over.setAttribute("aria-pressed", String(log.others));
      over.setAttribute("aria-label", `Lay ${log.name} over the log that is seen`);
      over.title = "Lay over";
      tab.append(over);
    }
    const close = button("close", "×", () => forget(log.id));
    close.setAttribute("aria-label", `Close ${log.name}`);
    tab.append(close);
    return tab;
  });
  at("logs").replaceChildren(...tabs);
  showOthers();
  if (logs.get(active)?.runs && !view.raw) showStory(); // it lists the other logs
}

/** Draw the runs of other logs over those of the same test, in their order. */
function showOthers() {
  const log = logs.get(active);
  if (!log?.runs) return;
  const laid = [];
  const colors = ["#9b5de5", "#c08a00", "#2a9d8f", "#d0539a"];
  const others = [...logs.values()].filter((one) => one.others && one.id !== active && one.runs);
  for (const [k, other] of others.entries()) {
    const used = new Set();
    for (const [run, mine] of log.runs.entries()) {
      const theirs = other.runs.find((one) => one.test === mine.test && !used.has(one));
      if (!theirs) continue;
      used.add(theirs);
      const factor = other.summary.units.si / log.summary.units.si;
      laid.push({ color: colors[k % colors.length], run, time: theirs.time, velocity: theirs.velocity.map((value) => value * factor) });
    }
  }
  chart.setOthers(laid);
  document.querySelector(".legend .other").hidden = !others.length;
}

function showRefusal(name, problem) {
  const card = text("article", "", "refusal");
  card.setAttribute("role", "alert");
  card.append(text("h3", name), text("p", `${problem.what ?? problem.message}.`), text("p", problem.advice ?? "", "advice"));
  const close = button("close", "×", () => card.remove());
  close.setAttribute("aria-label", "Close this message");
  card.append(close);
  at("refusals").prepend(card);
}

function setLoading(log, busy) {
  if (log.id === active) at("loading").classList.toggle("busy", busy);
}

// ---- helper functions

function say(words) {
  const toast = at("toast");
  toast.textContent = words;
  toast.classList.add("seen");
  clearTimeout(say.waiting);
  say.waiting = setTimeout(() => toast.classList.remove("seen"), 2600);
}

/** The gains that differ from those of the fit. */
function movedGains({ fit, gains }) {
  const moved = fit.gains.filter(({ name, value }) => gains[name] !== value);
  return Object.fromEntries(moved.map(({ name }) => [name, gains[name]]));
}

async function showCode() {
  const log = logs.get(active);
  const [language, season] = [at("language").value, at("season").value];
  at("radius-row").hidden = ["java", "python"].includes(language);
  const query = { ...modelQuery(log), ...movedGains(log), language, season, radius: at("radius").value.replace(",", ".") };
  try {
    at("code-text").textContent = (await askLog(log.id, "code", query)).code;
  } catch (problem) {
    at("code-text").textContent = sentence(problem);
  }
}

async function copy(place) {
  try {
    await navigator.clipboard.writeText(place.textContent);
    say("Copied.");
  } catch {
    getSelection().selectAllChildren(place);
    say("Selected. Copy it with the keyboard.");
  }
}

// ---- input

at("file").addEventListener("change", (event) => {
  openAll(event.target.files);
  event.target.value = "";
});
at("example").addEventListener("click", () => guarded("example", async () => begin(await openExample())));
at("reset").addEventListener("click", () => sliders.reset());
at("paste").addEventListener("click", async () => { await showCode(); at("code").showModal(); });
at("copy").addEventListener("click", () => copy(at("code-text")));
for (const id of ["language", "season", "radius"]) at(id).addEventListener("change", showCode);
for (const id of ["type", "units"]) at(id).addEventListener("change", () => choose(id, at(id).value));

/** Read the log that is shown again, with another type or unit. */
function choose(what, value) {
  const log = logs.get(active);
  const before = log.query;
  log.query = { ...log.query, [what]: value };
  guarded(log.name, async () => {
    try {
      await askLog(log.id, "summary", log.query);
    } catch (problem) {
      log.query = before;
      showLog();
      throw problem;
    }
    await load(log);
  });
}

let over = 0;
addEventListener("dragenter", (event) => { event.preventDefault(); over++; at("veil").classList.add("seen"); });
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("dragleave", () => { if (--over <= 0) at("veil").classList.remove("seen"); });
addEventListener("drop", (event) => {
  event.preventDefault();
  over = 0;
  at("veil").classList.remove("seen");
  if (event.dataTransfer.files.length) openAll(event.dataTransfer.files);
});

// ---- color theme: as the system, light, dark

const THEMES = [["", "half", "as the system"], ["light", "light", "light"], ["dark", "dark", "dark"]];

function setTheme(name) {
  const [, sign, words] = THEMES.find(([one]) => one === name) ?? THEMES[0];
  if (name) document.documentElement.dataset.theme = name;
  else delete document.documentElement.dataset.theme;
  at("theme").dataset.sign = sign;
  at("theme").setAttribute("aria-label", `Color theme: ${words}`);
  try {
    localStorage.setItem("theme", name);
  } catch { /* a browser that keeps nothing */ }
  chart.readColors();
}

at("theme").addEventListener("click", () => {
  const now = document.documentElement.dataset.theme ?? "";
  setTheme(THEMES[(THEMES.findIndex(([name]) => name === now) + 1) % THEMES.length][0]);
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => chart.readColors());

/** Keep the gains visible while scrolling; of a column taller than the screen, its end. */
new ResizeObserver(([{ target }]) => {
  target.style.setProperty("--top", `${Math.min(12, innerHeight - target.offsetHeight - 12)}px`);
}).observe(document.querySelector(".side"));

let kept = "";
try {
  kept = localStorage.getItem("theme") ?? "";
} catch { /* a browser that keeps nothing */ }
setTheme(kept);
guarded("logs", async () => {
  view = await askView();
  document.body.classList.toggle("raw", view.raw);
  document.body.classList.toggle("saved", Boolean(saved));
  document.body.classList.toggle("untold", saved && !Object.keys(saved).some((one) => one.endsWith("/reconcile")));
  showSignals(view.raw);
  const named = await listLogs();
  await Promise.all(named.map((one) => guarded(one.name, () => begin(one))));
});
followLive().catch((problem) => {
  at("live-status").textContent = sentence(problem);
  if (!(problem instanceof Refused)) console.error(problem);
});
