// Functions that make elements of the page.

/** An element with a class or properties and attributes, and with children: elements and texts. */
export function make(tag, given = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(typeof given === "string" ? { className: given } : given)) {
    if (name in made) made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children.flat().filter(Boolean));
  return made;
}

export function button(kind, words, onclick, more = {}) {
  return make("button", { type: "button", className: kind, onclick, ...more }, words);
}

/** A sentence as nodes: code is marked, and a number stays with its unit. */
export function prose(words) {
  const here = words.replaceAll("± ", "±\u00a0").replaceAll(" %", "\u00a0%").replace(/(\d) (V|rad|m?s)\b/g, "$1\u00a0$2");
  return here.split("`").map((part, k) => (k % 2 ? make("code", "", part) : part));
}

/** An item of which only the first sentence is seen until it is opened. */
export function foldedItem(kind, title, words, ...more) {
  const [, first, rest] = words.trim().match(/^(.*?[.!?](?=\s+[A-Z`]|$)|.*)\s*(.*)$/s);
  const head = make("summary", { title: first }, make("b", "", title), " ", prose(first));
  return make("li", kind, make("details", "", head, rest && make("p", "", prose(rest)), more));
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
  if (value === 0) return "0";
  const size = Math.abs(value);
  const digits = size >= 100 ? 0 : size >= 10 ? 2 : size >= 1 ? 3 : size >= 0.001 ? 4 : 5;
  return value.toFixed(digits).replace("-", "−");
}

export function sentence(problem) {
  return `${problem.what ?? problem.message}. ${problem.advice ?? ""}`.replace(/^./, (one) => one.toUpperCase());
}
