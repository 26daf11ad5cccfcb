// The open logs, and what is known of each: its runs, faults, gains and missing effects.

import { Refused, addressOf, ask, askLog, askSamples, saved } from "./api.js";
import { sentence } from "./elements.js";
import { guarded, say } from "./page.js";
import { simulate } from "./simulation.js";

const FINEST = 1000; // times of a part to leave out are rounded to 1/FINEST s
const SIGNALS = 4; // arrays of a run: time, voltage, position, velocity
const POLL = 250; // [ms] between two requests for the progress of a search
const KEPT = ["query", "leftOut", "others", "effects"]; // kept while the page is reloaded

export const logs = new Map();
export const state = { active: null, view: { raw: false, span_text: {} } }; // view: the PageView of the server
const begun = new Set(); // numbers of the logs that are or were open
const kept = saved?.choices ?? history.state ?? { logs: {} }; // the choices before the page was saved or loaded again
let tell = () => {};

/** Call a function with "tabs" when the open logs change, or with what has changed of the log that is shown. */
export function onChange(show) {
  tell = show;
}

function changed(log, what) {
  if (log.id === state.active) tell(what);
}

export function shownLog() {
  return logs.get(state.active);
}

/** Whether another log, once read, has positions of the same kind: lengths, or angles. */
export const isAlike = (one, log) => one.runs && log?.runs && one.summary.units.angular === log.summary.units.angular;

/** Show a log. */
export function activate(id) {
  state.active = id;
  tell("log");
  tell("tabs");
}

/** Open dropped files, and show the first of them. */
export async function openAll(files) {
  await Promise.all([...files].map((file, k) => guarded(file.name, async () =>
    begin(await ask(`logs?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file }), { show: k === 0 }))));
}

/** Add a log that the server opened: read it, show it, then request faults and gains.
 *
 * A log that is dropped while the page requests the open logs is named twice, but added once.
 */
export async function begin({ id, name, revision = 0 }, { show = id === kept.active } = {}) {
  if (begun.has(id)) return;
  begun.add(id);
  const { moved, settings, effects, ...before } = kept.logs[id] ?? {};
  const log = { id, name, revision, query: {}, others: false, leftOut: [], ...before };
  logs.set(id, log);
  if (show || state.active === null) activate(id);
  else tell("tabs");
  await load(log);
  if (settings) await reconcile(log, settings, effects);
  if (moved && log.fit && !log.fit.tracks) {
    log.gains = { ...log.gains, ...moved };
    changed(log, "fit");
  }
}

/** Keep the choices of each log, until the page is loaded again. */
export function keepChoices() {
  const choices = [...logs.values()].map((log) => [log.id, {
    ...Object.fromEntries(KEPT.map((name) => [name, log[name]])),
    moved: log.moved ? log.gains : undefined,
    settings: log.search?.settings,
  }]);
  history.replaceState({ active: state.active, logs: Object.fromEntries(choices) }, "");
}

/** Read a log with the options in its query; a choice of signals that fails is offered again. */
export async function load(log) {
  Object.assign(log, { faults: null, fit: null, fitRefused: null, search: null, effects: [] });
  const asked = (log.asked = {});
  setBusy(log, true);
  try {
    const [summary, samples] = await Promise.all([
      askLog(log.id, "summary", log.query),
      askSamples(log.id, log.query),
    ]);
    if (log.asked !== asked) return;
    take(log, summary, samples);
  } catch (problem) {
    setBusy(log, false);
    if (await offerChoice(log, problem)) return;
    forget(log.id);
    throw problem;
  }
  log.choice = null;
  changed(log, "log");
  tell("tabs");
  if (!state.view.raw) await Promise.all([askFaults(log, asked), askFit(log, asked)]);
  setBusy(log, false);
}

/** Read a log again with another type or unit; if that fails, it stays as it was. */
export async function choose(log, what, value) {
  const before = log.query;
  log.query = { ...log.query, [what]: value };
  await guarded(log.name, async () => {
    try {
      await askLog(log.id, "summary", log.query);
    } catch (problem) {
      log.query = before;
      changed(log, "log");
      throw problem;
    }
    await load(log);
  });
}

/** Let the user choose signals, if some are missing or were chosen wrongly; returns whether so. */
export async function offerChoice(log, problem = null) {
  if (problem && problem.kind !== "MissingSignal" && !log.choice) return false;
  const entries = log.choice?.entries ?? await askLog(log.id, "entries").catch(() => []);
  if (entries.every((one) => one.text)) return false; // no log, but some other text
  const why = !problem ? "Choose them again." : log.choice ? sentence(problem) : `${problem.what}.`;
  log.choice = { entries, why, chosen: { ...log.query }, columns: problem?.asks === "columns" || (log.choice?.columns ?? Boolean(log.query.time)) };
  changed(log, "log");
  tell("tabs");
  return true;
}

/** Split the samples into runs; positions and velocities in the log's unit, times in seconds. */
function take(log, summary, samples) {
  log.summary = summary;
  let from = 0;
  const next = (count) => samples.subarray(from, (from += count));
  const inUnit = (values) => (summary.units.si === 1 ? values : values.map((value) => value / summary.units.si));
  log.runs = summary.runs.map((run) => {
    const [time, voltage, position, velocity] = Array.from({ length: SIGNALS }, () => next(run.samples));
    const part = summary.runs.some((one) => one.part !== run.part) ? run.part : "";
    return { ...run, part, time, voltage, position: inUnit(position), velocity: inUnit(velocity) };
  });
}

/** Take the values of one more entry of a log; without a name, none. */
export async function takeEntry(log, name) {
  const values = name ? await askSamples(log.id, { ...log.query, name }, "entry") : null;
  let from = 0;
  for (const run of log.runs) run.entry = values?.subarray(from, (from += run.time.length));
  log.entry = name;
}

async function askFaults(log, asked) {
  const found = await askLog(log.id, "faults", log.query).catch((problem) => ({
    faults: [], clean: false, refused: true, doubts: [{ code: "", message: sentence(problem), grave: true }],
  }));
  if (log.asked !== asked) return;
  log.faults = found; // those to show, the surest first, and those alike in the order of the log; in a log that grows, a missing test is none
  found.faults = found.faults.filter(({ fault }) => !(log.revision && fault === "missing-test")).sort((a, b) => (a.sureness === b.sureness ? 0 : b.confidence - a.confidence));
  changed(log, "faults");
}

async function askFit(log, asked) {
  try {
    const fit = await askLog(log.id, "fit", modelQuery(log));
    if (log.asked !== asked) return;
    log.plain = fit;
    takeFit(log, fit);
    log.plainSimulated = log.simulated;
    log.fitError = log.error;
  } catch (problem) {
    if (!(problem instanceof Refused)) throw problem;
    log.fitRefused = problem;
  }
  changed(log, "fit");
  if (!log.fit) return;
  const more = await askLog(log.id, "directions", modelQuery(log)).catch(() => null);
  if (more === null || log.asked !== asked) return;
  const { doubts, notes } = log.plain;
  Object.assign(log.plain, more, { doubts: [...doubts, ...more.doubts], notes: [...notes, ...more.notes] });
  changed(log, "doubts");
}

/** Show the gains of a fit, or of a model with effects. */
function takeFit(log, fit) {
  log.fit = fit;
  log.moved = false;
  log.gains = Object.fromEntries(fit.gains.map((gain) => [gain.name, gain.value]));
  log.error = simulate(log, log.gains);
}

/** Fit again without these parts: {test, start, end}, in the log's time. */
export function leaveOut(log, parts) {
  const named = new Map(parts.map((part) => [nameOfPart(part), part])); // each once
  if (log.search) say("The log has changed, so its search is gone. Search again.");
  Object.assign(log, { leftOut: [...named.values()], effects: [], search: null, fit: null, fitRefused: null, asked: {} });
  setBusy(log, true);
  for (const what of ["faults", "fit", "story"]) changed(log, what);
  guarded(log.name, () => askFit(log, log.asked)).then(() => setBusy(log, false));
}

export function nameOfPart({ test, start, end }) {
  return `${test}:${Math.floor(FINEST * start) / FINEST}-${Math.ceil(FINEST * end) / FINEST}`;
}

/** Close a log. */
export function forget(id) {
  logs.delete(id);
  ask(`logs/${id}`, { method: "DELETE" }).catch(() => {});
  if (state.active === id) activate([...logs.keys()].at(-1) ?? null);
  else tell("tabs");
}

function setBusy(log, busy) {
  log.busy = busy;
  changed(log, "busy");
}

// ---- missing effects

/** Search with these settings: {validation, held_out}: numbers of other logs; longer: try harder. */
export async function reconcile(log, settings, effects) {
  const { asked } = log;
  const search = (log.search = { words: "begins", share: 0, settings });
  if (log.effects.length) await chooseEffects(log, []);
  changed(log, "story");
  try {
    while (!search.story) {
      Object.assign(search, await askLog(log.id, "reconcile", modelQuery(log)));
      if (log.asked !== asked) return;
      changed(log, "story");
      if (!search.story) await new Promise((done) => setTimeout(done, POLL));
    }
    const chosen = effects ?? (search.story.why_unticked ? [] : search.story.effects);
    if (chosen.length && log.plain) await chooseEffects(log, chosen);
  } catch (problem) {
    if (log.asked !== asked) return;
    search.refused = sentence(problem);
    changed(log, "story");
  }
}

/** Let a search end with what it has. */
export function stop(log) {
  log.search.stopped = true;
  ask(addressOf(log.id, "reconcile", modelQuery(log)), { method: "DELETE" });
  changed(log, "story");
}

/** The query for data about the chosen model. */
export function modelQuery(log) {
  return { ...log.query, ...log.search?.settings, effects: log.effects.join(), left_out: saved ? "" : log.leftOut.map(nameOfPart).join() }; // a saved page has answers for one choice of parts
}

/** Show gains and curves of the model with these effects; without any, those of the fit. */
export async function chooseEffects(log, effects) {
  const { asked, effects: before } = log;
  log.effects = effects;
  try {
    const fit = effects.length ? { ...log.plain, ...await askLog(log.id, "fit", modelQuery(log)) } : log.plain;
    if (log.asked !== asked || log.effects !== effects) return;
    takeFit(log, fit);
  } catch (problem) {
    log.effects = before;
    changed(log, "story");
    throw problem;
  }
  changed(log, "fit");
  changed(log, "story");
}
