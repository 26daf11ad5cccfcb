// What the page asks its server; addresses are relative, so nothing else is ever asked.

/** A refusal of the server: what is wrong, where, and what to do next. */
export class Refused extends Error {
  constructor({ what, where, advice, kind }) {
    super(what);
    this.what = what.replace(/\.$/, "");
    this.where = where;
    this.advice = advice;
    this.kind = kind;
  }
}

/** Open a dropped file; its number and its name. */
export function openFile(file) {
  return ask(`logs?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file });
}

/** Open a simulated log. */
export function openExample() {
  return ask("example", { method: "POST" });
}

/** The logs that were named on the command line, or opened before the page was loaded again. */
export function listLogs() {
  return ask("logs");
}

/** What this page shows of every log: the data alone, and how marked spans are written. */
export function askView() {
  return ask("view");
}

/** What sysid watch follows, and the logs that grow. */
export function askLive() {
  return ask("live");
}

/** Close a log. */
export function closeLog(id) {
  return ask(`logs/${id}`, { method: "DELETE" });
}

/** What the server knows of a log: summary, faults, fit, directions, code. */
export function askLog(id, what, query = {}) {
  return ask(addressOf(id, what, query));
}

/** The samples of a log: one array after another, in SI. */
export async function askSamples(id, query) {
  return new Float64Array(await (await fetchOrRefuse(addressOf(id, "samples", query))).arrayBuffer());
}

/** Where something about a log is. */
export function addressOf(id, what, query = {}) {
  const given = Object.entries(query).filter(([, value]) => value !== undefined && value !== "");
  const text = new URLSearchParams(given).toString();
  return `logs/${id}/${what}${text ? `?${text}` : ""}`;
}

async function ask(address, options) {
  return (await fetchOrRefuse(address, options)).json();
}

async function fetchOrRefuse(address, options) {
  let answer;
  try {
    answer = await fetch(address, options);
  } catch {
    throw new Refused({
      what: "the program that serves this page has ended",
      where: "",
      advice: "Start it again: sysid open, or sysid watch",
    });
  }
  if (!answer.ok) throw new Refused((await answer.json()).refusal);
  return answer;
}
