// Rows to choose the entries of signals that were not found by name.

import { figure, text } from "./elements.js";

const ROLES = [
  ["voltage", "Voltage at the motor", false],
  ["position", "Position", false],
  ["velocity", "Velocity", false],
  ["state", "Name of the running test", true],
];

/** A row for each signal: a menu of entries, and a small plot of the chosen one. */
export function makeSignalRows(entries, chosen) {
  return ROLES.map(([role, words, isText]) => {
    const row = text("label", "", "signal");
    const select = document.createElement("select");
    select.name = role;
    select.setAttribute("aria-label", words);
    select.append(new Option(role === "velocity" ? "the slope of the position" : "found by its name", ""));
    for (const one of entries.filter((entry) => entry.text === isText)) {
      select.append(new Option(`${one.name}${one.unit ? ` [${one.unit}]` : ""}`, one.name));
    }
    select.value = chosen[role] ?? "";
    const place = text("div", "", "spark");
    const draw = () => {
      const one = entries.find((entry) => entry.name === select.value);
      place.replaceChildren(...(one ? [isText ? text("span", `${one.samples} times`) : sparkline(one.picture)] : []));
    };
    select.addEventListener("change", draw);
    draw();
    row.append(text("span", words, "role"), select, place);
    return row;
  });
}

/** A small plot of an entry. */
function sparkline(values) {
  const svg = "http://www.w3.org/2000/svg";
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const points = values.map((value, k) => `${((200 * k) / Math.max(values.length - 1, 1)).toFixed(1)} ${(34 - (30 * (value - low)) / (high - low || 1)).toFixed(1)}`);
  const picture = document.createElementNS(svg, "svg");
  const path = document.createElementNS(svg, "path");
  picture.setAttribute("viewBox", "0 0 200 38");
  picture.setAttribute("preserveAspectRatio", "none");
  picture.setAttribute("role", "img");
  picture.setAttribute("aria-label", `from ${figure(low)} to ${figure(high)}`);
  path.setAttribute("d", `M${points.join("L")}`);
  picture.append(path);
  return picture;
}
