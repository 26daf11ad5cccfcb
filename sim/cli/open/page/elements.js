// Functions that make elements of the page.

/** A sentence of the command line as nodes: options get the page's words, and code is marked. */
export function prose(words) {
  const here = words.replaceAll("± ", "±\u00a0").replaceAll(" %", "\u00a0%").replace(/(\d) (V|rad)\b/g, "$1\u00a0$2")
    .replace(/([Ss])ay --(type|units)\b/g, (_, s, what) => `${s === "S" ? "Choose" : "choose"} the ${what} above`)
    .replace(/--(type|units)\b/g, "$1")
    .replace(/(^|\. )`sysid reconcile`/g, "$1The search below").replaceAll("`sysid reconcile`", "the search below");
  return here.split("`").map((part, k) => (k % 2 ? text("code", part) : part));
}

export function text(tag, words, kind = "") {
  const made = document.createElement(tag);
  made.textContent = words;
  if (kind) made.className = kind;
  return made;
}

export function item(kind, words = "") {
  return text("li", words, kind);
}

export function button(kind, words, press) {
  const made = text("button", words, kind);
  made.type = "button";
  made.addEventListener("click", press);
  return made;
}

export function figure(value) {
  const size = Math.abs(value);
  const digits = size >= 100 ? 0 : size >= 10 ? 2 : size >= 1 ? 3 : size >= 0.001 ? 4 : 5;
  return value.toFixed(digits).replace("-", "−");
}

export function sentence(problem) {
  return `${problem.what ?? problem.message}. ${problem.advice ?? ""}`;
}
