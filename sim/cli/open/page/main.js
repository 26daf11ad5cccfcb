// The page: shows what has changed of the open logs, and takes files.

import { Refused, ask, saved } from "./api.js";
import { showChoice } from "./choices.js";
import { sentence } from "./elements.js";
import { showFit, sliders } from "./gains.js";
import { followLive } from "./live.js";
import { openLoops } from "./loops.js";
import { begin, choose, keepChoices, logs, offerChoice, onChange, openAll, shownLog, state } from "./logs.js";
import { at, guarded } from "./page.js";
import { chart, showReading, showSignals, showStage } from "./stage.js";
import { showStory } from "./story.js";
import { showTabs } from "./tabs.js";
import { showDoubts, showFaults } from "./verdict.js";

window.sysid = { chart, sliders, logs, begin }; // for tests and for debugging

const SHOW = {
  log: showLog,
  tabs: () => {
    showTabs();
    if (shownLog()?.runs && !state.view.raw) showStory(); // it lists the other logs
  },
  faults: showFaults, fit: showFit, doubts: showDoubts, story: showStory,
  busy: () => at("loading").classList.toggle("busy", Boolean(shownLog()?.busy)),
};
onChange((what) => SHOW[what]());

function showLog() {
  const log = shownLog();
  at("empty").hidden = Boolean(log);
  at("work").hidden = !log || Boolean(log.choice);
  at("choose").hidden = !log?.choice;
  at("work").classList.toggle("reading", !log?.runs);
  document.title = log ? `${log.name} – sysid` : "sysid";
  if (log?.choice) return showChoice();
  if (!log?.runs) return showReading(log);
  showStage();
  if (!state.view.raw) for (const show of [showFaults, showFit, showStory]) show();
  SHOW.busy();
}

at("file").addEventListener("change", (event) => {
  openAll(event.target.files);
  event.target.value = "";
});
for (const id of ["feedback", "theory"]) at(id).addEventListener("click", openLoops);
at("example").addEventListener("click", () => guarded("example", async () => begin(await ask("example", { method: "POST" }), { show: true })));
at("rechoose").addEventListener("click", () => offerChoice(shownLog()));
for (const id of ["type", "units"]) at(id).addEventListener("change", () => choose(shownLog(), id, at(id).value));

const cover = (seen) => at("veil").classList.toggle("seen", seen);
addEventListener("dragover", (event) => { event.preventDefault(); cover(true); });
addEventListener("dragleave", (event) => { if (!event.relatedTarget) cover(false); });
addEventListener("drop", (event) => {
  event.preventDefault();
  cover(false);
  if (event.dataTransfer.files.length) openAll(event.dataTransfer.files);
});

/** Keep the gains visible while scrolling; of a column taller than the screen, its end. */
new ResizeObserver(([{ target }]) => {
  target.style.setProperty("--top", `${Math.min(12, innerHeight - target.offsetHeight - 12)}px`);
}).observe(document.querySelector(".side"));

chart.readColors();
at("theme").addEventListener("change", () => chart.readColors());
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => chart.readColors());
guarded("logs", async () => {
  state.view = await ask("view");
  document.body.classList.toggle("raw", state.view.raw);
  document.body.classList.toggle("saved", Boolean(saved));
  document.body.classList.toggle("untold", saved && !Object.keys(saved).some((one) => one.endsWith("/reconcile")));
  showSignals(state.view.raw);
  addEventListener("beforeunload", keepChoices);
  const named = await ask("logs");
  await Promise.all(named.map((one) => guarded(one.name, () => begin(one))));
});
followLive().catch((problem) => {
  at("live-status").textContent = sentence(problem);
  if (!(problem instanceof Refused)) console.error(problem);
});
