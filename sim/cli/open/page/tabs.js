// The tabs of the open logs.

import { button, drawing, make } from "./elements.js";
import { activate, forget, isAlike, logs, shownLog, state } from "./logs.js";
import { at } from "./page.js";
import { showOthers } from "./stage.js";

const LAID_OVER = "M2 14C5 14 5 6 9 6h5M2 10C4 10 4 2 8 2h6"; // two curves

export function showTabs() {
  at("logs").replaceChildren(...[...logs.values()].map(makeTab));
  at("logs").querySelector(".now")?.scrollIntoView({ block: "nearest", inline: "nearest" });
}

function makeTab(log) {
  const now = log.id === state.active;
  const lay = () => { log.others = !log.others; showOthers(); showTabs(); };
  return make("div", `tab${now ? " now" : ""}`,
    button("name", log.name, () => activate(log.id), now ? { "aria-current": "true" } : {}),
    log.choice && make("span", "badge", "choose signals"),
    !now && isAlike(log, shownLog()) && button("over", [drawing("0 0 16 16", LAID_OVER), make("span", "", "lay over")], lay, {
      "aria-pressed": String(log.others), "aria-label": `Lay ${log.name} over the log that is seen`,
    }),
    button("close", "×", () => forget(log.id), { "aria-label": `Close ${log.name}` }));
}
