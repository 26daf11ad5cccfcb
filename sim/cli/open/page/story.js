// The story of a search for missing effects.

import { button, foldedItem, item, prose, text } from "./elements.js";
import { chooseEffects, logs, reconcile, shownLog, stop } from "./logs.js";
import { at, guarded } from "./page.js";
import { errorText, nameOf, rounded } from "./sliders.js";

export function showStory() {
  const log = shownLog();
  const { search } = log;
  const place = at("story");
  if (search && !search.story && !search.refused) {
    const bar = place.querySelector("progress") ?? Object.assign(document.createElement("progress"), { max: 1 });
    bar.value = search.share;
    bar.setAttribute("aria-label", "How far the search is");
    const end = place.querySelector(".stop") ?? button("button stop", "Stop", () => stop(log));
    end.disabled = search.stopped;
    place.replaceChildren(text("p", `${search.stopped ? "stopping after" : ""} ${search.words}…`, "quiet"), bar, end);
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

/** The headline, the models to choose from, the findings, and where the base model is wrong. */
function storyParts(story, log, choose) {
  const head = text("p", "", "headline");
  head.append(...prose(story.headline));
  const found = story.findings.map((one) => {
    const card = text("article", "", "finding");
    const name = text("h3", plain(one.name));
    name.append(text("span", one.kind === "fault" ? "damage" : one.size, "badge"));
    card.append(name, text("p", one.sentence));
    for (const words of one.parameters) card.append(text("p", words, "where"));
    for (const [title, words] of one.look) card.append(text("p", `${title}: ${words}`, "advice"));
    return card;
  });
  const rest = [story.caution, ...story.next.map((one) => `Test to run next: ${one}`), ...story.remarks]
    .filter(Boolean).map((words) => { const made = item("look"); made.append(...prose(words)); return made; });
  const places = story.places.length
    ? [text("p", "Where the base model is wrong most", "quiet places"), list(story.places.map((one) => item("busy", one)))]
    : [];
  const tried = foldedItem("busy", "Tried", `Score of each effect, and what became of it. ${story.tried.join("; ")}.`);
  const models = story.effects.length && log.plain ? [modelChoice(story, log, choose)] : [];
  return [head, ...models, gapBars(story), ...found, list([...rest, tried]), ...places, text("p", story.how, "quiet how")];
}

/** A box to tick for each effect, and the gains without effects and with those ticked. */
function modelChoice({ effects }, { effects: chosen, plain: without, fit }, choose) {
  const boxes = text("fieldset", "", "models");
  boxes.append(text("legend", "Effects in the model"), ...effects.map((name) => {
    const label = text("label", "");
    const box = Object.assign(document.createElement("input"), { type: "checkbox", checked: chosen.includes(name) });
    box.addEventListener("change", () => choose(effects.filter((one) => (one === name ? box.checked : chosen.includes(one)))));
    label.append(box, plain(name));
    return label;
  }));
  const table = text("table", "", "gains-table");
  const say = ({ value, ...gain }) => `${rounded(value, gain.error)} ± ${errorText(gain)}`;
  const row = (tag, words) => { const made = text("tr", ""); made.append(...words.map((one) => text(tag, one))); return made; };
  table.append(
    row("th", ["gain", "without", chosen.length ? `with ${chosen.map(plain).join(", ")}` : "with the ticked effects", "unit"]),
    ...without.gains.map((gain, k) => row("td", [nameOf(gain.name), say(gain), chosen.length ? say(fit.gains[k]) : "–", gain.unit])),
  );
  boxes.append(table);
  return boxes;
}

/** Other open logs that take part, and the button that begins a search. */
function searchForm(search, others, begin) {
  const form = text("div", "", "row search");
  const pick = (title, role) => {
    const label = text("label", `${title} `);
    const select = document.createElement("select");
    select.append(new Option("no other log", ""), ...others.map((one) => new Option(one.name, one.id)));
    select.value = search?.settings[role] ?? "";
    label.append(select);
    return [label, select];
  };
  const [[confirm, validation], [show, heldOut]] = [pick("Confirm effects with", "validation"), pick("Show the gap on", "held_out")];
  const press = (words, longer) => button("button", words, () => begin({ validation: validation.value, held_out: heldOut.value, longer }));
  if (others.length) form.append(confirm, show);
  if (!search) form.append(press("Look for what is missing", ""));
  else if (search.story && !search.story.complete) form.append(press("Search five times as long", "1"));
  else if (others.length) form.append(press("Search again", ""));
  return form;
}

/** The gap of each model as a bar, in times the noise; 1 is noise alone. */
function gapBars({ gaps }) {
  const most = Math.max(1, ...gaps.map(({ gap }) => gap ?? 0));
  const rows = gaps.map(({ name, text: words, gap }, k) => {
    const row = text("div", "", k === gaps.length - 1 ? "last" : "");
    const bar = text("i", "");
    bar.style.setProperty("--share", (gap ?? most) / most);
    row.append(text("span", name), bar, text("b", words));
    return row;
  });
  const bars = text("div", "", "gaps");
  bars.append(text("p", "Simulation error, in times the noise of the velocity", "quiet"), ...rows);
  return bars;
}

function plain(name) {
  return name.replaceAll("-", " ");
}

function list(rows) {
  const made = text("ul", "", "doubts");
  made.append(...rows);
  return made;
}
