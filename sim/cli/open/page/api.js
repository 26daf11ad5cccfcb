// Requests of the page to its server; addresses are relative, so no other server is used.

/** An error of the server: what is wrong, where, and what to do next. */
export class Refused extends Error {
  constructor(refusal) {
    super(refusal.what);
    Object.assign(this, refusal, { what: refusal.what.replace(/\.$/, "") });
  }
}

/** The answers of a page that was saved as one file: address -> answer; null if a server answers. */
export const saved = JSON.parse(document.getElementById("saved")?.textContent ?? "null");

/** Data about a log: summary, faults, fit, directions or code. */
export function askLog(id, what, query = {}) {
  return ask(addressOf(id, what, query));
}

/** Samples of a log, one array after another: its signals in SI, or those of one entry as they are. */
export async function askSamples(id, query, what = "samples") {
  return new Float64Array(await (await fetchOrRefuse(addressOf(id, what, query))).arrayBuffer());
}

/** The address of data about a log. */
export function addressOf(id, what, query = {}) {
  const given = Object.entries(query).filter(([, value]) => value !== undefined && value !== "");
  const text = new URLSearchParams(given).toString();
  return `logs/${id}/${what}${text ? `?${text}` : ""}`;
}

/** The answer to a request: "logs" are those open, "view" what the page shows, "live" what sysid watch follows. */
export async function ask(address, options) {
  return (await fetchOrRefuse(address, options)).json();
}

async function fetchOrRefuse(address, options) {
  if (saved) return readSaved(address);
  const ended = { what: "the program behind this page has ended", advice: "Start it again: sysid open, or sysid watch" };
  const answer = await fetch(address, options).catch(() => { throw new Refused(ended); });
  if (answer.headers.get("content-type") === "application/problem+json") throw new Refused((await answer.json()).refusal);
  return answer;
}

function readSaved(address) {
  const answer = saved[address];
  if (answer === undefined) throw new Refused({ what: "a saved page cannot compute anything new", advice: "Open the log itself with `sysid open`." });
  if (answer.refusal) throw new Refused(answer.refusal);
  return new Response(typeof answer === "string" ? Uint8Array.from(atob(answer), (one) => one.charCodeAt(0)) : JSON.stringify(answer));
}
