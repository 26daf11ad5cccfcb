// The page itself: its elements, messages, and the clipboard.

import { Refused } from "./api.js";
import { button, make } from "./elements.js";

export const at = (id) => document.getElementById(id);

/** Do something for one file; an error is shown, and the rest of the page keeps working. */
export async function guarded(name, work) {
  try {
    await work();
  } catch (problem) {
    if (!(problem instanceof Refused)) console.error(problem);
    showRefusal(name, problem);
  }
}

function showRefusal(name, problem) {
  const card = make("article", { className: "refusal", role: "alert" },
    make("h3", "", problem.where || name), make("p", "", `${problem.what ?? problem.message}.`), make("p", "advice", problem.advice),
    button("close", "×", () => card.remove(), { "aria-label": "Close this message" }));
  at("refusals").prepend(card);
}

/** Say something for a moment. */
export function say(words) {
  const toast = at("toast");
  toast.textContent = words;
  toast.showPopover();
  toast.classList.add("seen");
  clearTimeout(say.waiting);
  say.waiting = setTimeout(() => { toast.classList.remove("seen"); toast.hidePopover(); }, 2600);
}

export async function copy(place) {
  try {
    await navigator.clipboard.writeText(place.textContent);
    say("Copied.");
  } catch {
    getSelection().selectAllChildren(place);
    say("Selected. Copy it with the keyboard.");
  }
}
