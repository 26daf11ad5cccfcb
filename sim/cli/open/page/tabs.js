// The tabs of the open logs.

import { button, drawing, text } from "./elements.js";
import { activate, forget, logs, state } from "./logs.js";
import { at } from "./page.js";
import { showOthers } from "./stage.js";

const LAID_OVER = "M2 14C5 14 5 6 9 6h5M2 10C4 10 4 2 8 2h6"; // two curves

export function showTabs() {
  at("logs").replaceChildren(...[...logs.values()].map(makeTab));
  at("logs").querySelector(".now")?.scrollIntoView({ block: "nearest", inline: "nearest" });
}

function makeTab(log) {
  const now = log.id === state.active;
  const tab = text("div", "", `tab${now ? " now" : ""}`);
  const name = button("name", log.name, () => activate(log.id));
  if (now) name.setAttribute("aria-current", "true");
  tab.append(name);
  if (log.choice) tab.append(text("span", "choose signals", "badge"));
  if (!now && log.runs) {
    const over = button("over", "", () => { log.others = !log.others; showOthers(); showTabs(); });
    over.append(drawing("0 0 16 16", LAID_OVER));
    over.setAttribute("aria-pressed", String(log.others));
    over.setAttribute("aria-label", `Lay ${log.name} over the log that is seen`);
    over.title = "Lay over";
    tab.append(over);
  }
  const close = button("close", "×", () => forget(log.id));
  close.setAttribute("aria-label", `Close ${log.name}`);
  tab.append(close);
  return tab;
}
