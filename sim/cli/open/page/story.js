// The story of a search for missing effects.

import { button, foldedItem, make, prose } from "./elements.js";
import { chooseEffects, logs, reconcile, shownLog, stop } from "./logs.js";
import { at, guarded } from "./page.js";

export function showStory() {
  const log = shownLog();
  const { search } = log;
  const place = at("story");
  at("look").hidden = Boolean(search);
  showModels(log);
  if (search && !search.story && !search.refused) {
    const bar = place.querySelector("progress") ?? make("progress", { max: 1, "aria-label": "How far the search is" });
    const end = place.querySelector(".stop") ?? button("button stop", "Stop", () => stop(log));
    bar.value = search.share;
    end.disabled = search.stopped;
    place.replaceChildren(make("p", "quiet", `${search.stopped ? "stopping after" : ""} ${search.words}…`), bar, end);
    return;
  }
  const others = [...logs.values()].filter((one) => one !== log && one.runs);
  const parts = !search
    ? [make("p", "quiet", "Tries the effects of the catalogue, drag to backlash, and names those that explain the simulation error. ", log.summary.compiled
        ? "This takes seconds, and up to a minute on a slow laptop." : "This takes minutes: Numba is not installed. With the extra fast it takes seconds.")]
    : search.refused ? [make("li", "grave", search.refused)]
      : storyParts(search.story, log);
  const form = searchForm(search, others, (settings) => guarded(log.name, () => reconcile(log, settings)));
  const first = search?.story && !search.story.complete ? 1 : parts.length; // an unfinished search goes on from its headline
  place.replaceChildren(...parts.slice(0, first), form, ...parts.slice(first));
}

/** The headline, the models to choose from, the findings, and where the base model is wrong. */
function storyParts(story, log) {
  const found = story.findings.map((one) => make("article", "finding",
    make("h3", "", one.name, make("span", "badge", one.kind === "fault" ? "damage" : one.size)),
    make("p", "", one.sentence),
    one.parameters.map((words) => make("p", "where", words)),
    one.look.map(([title, words]) => make("p", "advice", `${title}: ${words}`))));
  const rest = [story.caution, ...story.next.map((one) => `Test to run next: ${one}`), ...story.remarks]
    .filter(Boolean).map((words) => make("li", "look", prose(words)));
  const places = story.places.length
    ? [make("p", "quiet places", "Where the base model is surely wrong, the largest first"), make("ul", "doubts", story.places.map((one) => make("li", "busy", one)))]
    : [];
  const tried = foldedItem("busy", "Tried", `What became of each effect. ${story.tried.join("; ")}.`);
  const models = story.effects.length && log.plain ? [gainsTable(story, log)] : [];
  return [make("p", "headline", prose(story.headline)), ...models, gapBars(story), ...found, make("ul", "doubts", rest, tried), ...places, make("p", "quiet how", story.how)];
}

/** A box to tick for each effect that was found, above the curves that it changes. */
function showModels(log) {
  const effects = log.plain ? log.search?.story?.effects ?? [] : [];
  const boxes = effects.map((name) => {
    const chosen = (ticked) => effects.filter((one) => (one === name ? ticked : log.effects.includes(one)));
    const onchange = ({ target }) => guarded(log.name, () => chooseEffects(log, chosen(target.checked)));
    return make("label", "", make("input", { type: "checkbox", checked: log.effects.includes(name), onchange }), name);
  });
  at("models").hidden = !effects.length;
  at("models").replaceChildren(make("legend", "", "Effects in the model"), ...boxes);
}

/** The gains without effects and with those ticked. */
function gainsTable({ why_unticked: reason }, { effects: chosen, plain: without, fit }) {
  const say = ({ text, error_text: error }) => `${text} ±\u00a0${error}`;
  const row = (tag, words) => make("tr", "", words.map((one) => make(tag, "", one)));
  const withThem = chosen.length ? [`with ${chosen.join(", ")}`] : [];
  const table = make("table", "gains-table", row("th", ["gain", "without", ...withThem, "unit"]),
    without.gains.map((gain, k) => row("td", [gain.label, say(gain), ...withThem.map(() => say(fit.gains[k])), gain.unit])));
  return make("div", "models", reason && make("p", "quiet", `${reason} Tick an effect to see what it changes.`), table,
    button("link", "Tick effects above the curves", () => at("models").scrollIntoView({ block: "center", behavior: "smooth" })));
}

/** Other open logs that take part, and the button that begins a search. */
function searchForm(search, others, begin) {
  const form = make("div", "row search");
  const pick = (title, role) => {
    const select = make("select", "", new Option("no other log", ""), others.map((one) => new Option(one.name, one.id)));
    select.value = search?.settings[role] ?? "";
    return [make("label", "", `${title} `, select), select];
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
function gapBars({ gaps, findings }) {
  const most = Math.max(1, ...gaps.map(({ gap }) => gap ?? 0));
  const rows = gaps.map(({ name, text, gap }, k) => make("div", k === gaps.length - 1 && (gap ?? most) < (gaps[k - 1]?.gap ?? 0) ? "last" : "",
    make("span", "", name), make("i", { style: `--share: ${(gap ?? most) / most}` }), make("b", "", text)));
  return make("div", "gaps", make("p", "quiet", `Simulation error at samples with a new reading${findings.some(({ kind }) => kind === "fault") ? " outside the damaged parts" : ""}, in times the noise of the velocity; above, it is over all samples`), rows);
}

at("look").addEventListener("click", () => {
  const log = shownLog();
  at("story").scrollIntoView({ block: "center", behavior: "smooth" });
  guarded(log.name, () => reconcile(log, {}));
});
