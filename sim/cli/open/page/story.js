// The story of a search for missing effects.

import { item, prose, text } from "./elements.js";

/** The headline, the gap of each model, the findings, and where the base model is wrong. */
export function storyParts(story) {
  const head = text("p", "", "headline");
  head.append(...prose(story.headline));
  const found = story.findings.map((one) => {
    const card = text("article", "", "finding");
    const name = text("h3", one.name.replaceAll("-", " "));
    name.append(text("span", one.kind === "fault" ? "damage" : one.size, "badge"));
    card.append(name, text("p", one.sentence));
    for (const words of one.parameters) card.append(text("p", words, "where"));
    for (const [title, words] of one.look) card.append(text("p", `${title}: ${words}`, "advice"));
    return card;
  });
  const rest = [...story.next.map((one) => `Test to run next: ${one}`), ...story.remarks]
    .map((words) => { const made = item("look"); made.append(...prose(words)); return made; });
  const places = story.places.length
    ? [text("p", "Where the base model is wrong most", "quiet places"), list(story.places.map((one) => item("busy", one)))]
    : [];
  return [head, gapBars(story), ...found, list(rest), ...places, text("p", story.how, "quiet")];
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

function list(rows) {
  const made = text("ul", "", "doubts");
  made.append(...rows);
  return made;
}
