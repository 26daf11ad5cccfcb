// Cuts a page of sections into slides: as much on each as the screen holds, one at a time.

const blocks = []; // everything below the headings, in order: {section, title, node}
const main = document.querySelector("main");
const sections = [...main.querySelectorAll(":scope > section")];

/** A part with an animation stays whole; a picture and its table may be parted. */
function collect(section) {
  const title = section.querySelector(":scope > h2")?.textContent ?? document.title;
  for (const node of [...section.childNodes]) {
    if (node.nodeType !== Node.ELEMENT_NODE || node.tagName === "H2") continue;
    const whole = !node.matches("div.wide") || node.querySelector("figure.motion");
    for (const one of whole ? [node] : [...node.children].map(wrap)) blocks.push({ section, title, node: one });
  }
}

function wrap(node) {
  const box = document.createElement("div");
  box.className = "wide";
  box.append(node);
  return box;
}

/** Put the blocks on slides, each as full as the screen allows. */
function cut() {
  const now = slides[shown]?.section;
  for (const { box } of slides) box.remove();
  slides.length = 0;
  let slide = null;
  for (const block of blocks) {
    if (slide?.section !== block.section) slide = open(block);
    slide.body.append(block.node);
    if (slide.box.scrollHeight <= slide.box.clientHeight || slide.body.childElementCount < 2) continue;
    const before = block.node.previousElementSibling;
    const heading = before.matches("h3, h4") && slide.body.childElementCount > 2 ? [before] : [];
    slide = open(block);
    slide.body.append(...heading, block.node);
  }
  for (const { box, body } of slides) shrink(box, body);
  shown = Math.max(slides.findIndex(({ section }) => section === now), 0);
  show(shown);
}

/** A table that alone is taller than the screen is drawn smaller. */
function shrink(box, body) {
  body.style.zoom = "";
  for (let zoom = 0.9; box.scrollHeight > box.clientHeight && zoom > 0.3; zoom -= 0.1) body.style.zoom = zoom;
}

function open({ section, title }) {
  const box = document.createElement("section");
  box.className = "slide";
  const again = slides.at(-1)?.section === section;
  const heading = document.createElement("h2");
  heading.textContent = again ? `${title} (continued)` : title;
  const body = document.createElement("div");
  box.append(heading, body);
  main.append(box);
  slides.push({ section, box, body });
  return slides.at(-1);
}

function show(number) {
  shown = Math.min(Math.max(number, 0), slides.length - 1);
  slides.forEach(({ box }, at) => { box.hidden = at !== shown; });
  place.textContent = `${shown + 1} / ${slides.length}`;
}

const slides = [];
let shown = 0;
const bar = document.createElement("nav");
bar.className = "bar";
bar.setAttribute("aria-label", "Slides");
const place = document.createElement("output");
for (const [text, name, way] of [["◀", "Slide before", -1], ["▶", "Next slide", 1]]) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = text;
  button.setAttribute("aria-label", name);
  button.addEventListener("click", () => show(shown + way));
  bar.append(button);
}
bar.children[0].after(place);
bar.append(...[...document.querySelectorAll("header nav a")].slice(-1)); // back to the page
document.body.append(bar);
document.documentElement.classList.add("cut");
sections.forEach(collect);
for (const section of sections) section.hidden = true;
cut();
addEventListener("load", cut); // pictures have their height then
let asked;
addEventListener("resize", () => { clearTimeout(asked); asked = setTimeout(cut, 150); });
addEventListener("keydown", (event) => {
  if (event.defaultPrevented || event.target.closest("input, select, button, summary, .motion")) return;
  const way = { ArrowRight: 1, PageDown: 1, " ": 1, ArrowLeft: -1, PageUp: -1 }[event.key];
  if (!way) return;
  event.preventDefault();
  show(shown + way);
});
