// Functions that make elements of the page.

/** A sentence as nodes: code is marked, and a number stays with its unit. */
export function prose(words) {
  const here = words.replaceAll("± ", "±\u00a0").replaceAll(" %", "\u00a0%").replace(/(\d) (V|rad)\b/g, "$1\u00a0$2");
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

/** An item of which only the first sentence is seen until it is opened. */
export function foldedItem(kind, title, words) {
  const made = item(kind);
  const folded = document.createElement("details");
  const [, first, rest] = words.trim().match(/^(.*?[.!?](?=\s+[A-Z`]|$)|.*)\s*(.*)$/s);
  const head = text("summary", "");
  head.append(text("b", title), " ", ...prose(first));
  folded.append(head, ...(rest ? [paragraph(rest)] : []));
  made.append(folded);
  return made;
}

function paragraph(words) {
  const made = text("p", "");
  made.append(...prose(words));
  return made;
}

export function button(kind, words, press) {
  const made = text("button", words, kind);
  made.type = "button";
  made.addEventListener("click", press);
  return made;
}

/** A path as a picture; without words it is decoration. */
export function drawing(box, path, words = "") {
  const [picture, line] = ["svg", "path"].map((name) => document.createElementNS("http://www.w3.org/2000/svg", name));
  picture.setAttribute("viewBox", box);
  picture.setAttribute(words ? "aria-label" : "aria-hidden", words || "true");
  if (words) picture.setAttribute("role", "img");
  line.setAttribute("d", path);
  picture.append(line);
  return picture;
}

export function figure(value) {
  const size = Math.abs(value);
  const digits = size >= 100 ? 0 : size >= 10 ? 2 : size >= 1 ? 3 : size >= 0.001 ? 4 : 5;
  return value.toFixed(digits).replace("-", "−");
}

export function sentence(problem) {
  return `${problem.what ?? problem.message}. ${problem.advice ?? ""}`;
}

export function capital(words) {
  return words[0].toUpperCase() + words.slice(1);
}
