// The logs of sysid watch, which grow.

import { ask } from "./api.js";
import { make, prose } from "./elements.js";
import { begin, load, logs } from "./logs.js";
import { at, guarded } from "./page.js";

const LOOK = 500; // [ms] between two requests for the status of sysid watch

/** Follow the logs of sysid watch: read a log again whenever a test in it has ended. */
export async function followLive() {
  for (;;) {
    const live = await ask("live");
    if (!live.follows) return;
    showLive(live);
    for (const { id, name, revision } of live.logs) {
      const log = logs.get(id);
      if (log?.revision === revision) continue;
      if (log) log.revision = revision;
      await guarded(name, () => (log ? load(log) : begin({ id, name, revision }, { show: true })));
    }
    await new Promise((done) => setTimeout(done, LOOK));
  }
}

function showLive({ status, counts, advice }) {
  at("live").hidden = false;
  at("empty").querySelector(".or").hidden = at("empty").querySelector(".primary").hidden = true;
  at("empty-title").textContent = "Waiting for the first test.";
  at("empty-lead").textContent = "Run the four tests in any order. The log appears here when one has ended.";
  at("live-status").textContent = status;
  const words = Object.entries(counts).map(([test, count]) => make("li", {
    className: count ? "done" : "", "aria-label": `${test}: ${count ? `${count} recorded` : "missing"}`,
  }, `${test}${count > 1 ? ` (${count})` : ""}`));
  at("live-tests").replaceChildren(...words);
  const said = at("live-next");
  if (said.dataset.said !== advice) said.replaceChildren(...prose(advice)); // only when it has changed
  said.dataset.said = advice;
}
