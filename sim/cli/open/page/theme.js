// The color theme: as the system, light, dark.

import { at, keep, recall } from "./page.js";
import { chart } from "./stage.js";

const THEMES = [["", "half", "as the system"], ["light", "light", "light"], ["dark", "dark", "dark"]];

export function setTheme(name = recall("localStorage", "theme") ?? "") {
  const [, sign, words] = THEMES.find(([one]) => one === name) ?? THEMES[0];
  if (name) document.documentElement.dataset.theme = name;
  else delete document.documentElement.dataset.theme;
  at("theme").dataset.sign = sign;
  at("theme").setAttribute("aria-label", `Color theme: ${words}`);
  keep("localStorage", "theme", name);
  chart.readColors();
}

at("theme").addEventListener("click", () => {
  const now = document.documentElement.dataset.theme ?? "";
  setTheme(THEMES[(THEMES.findIndex(([name]) => name === now) + 1) % THEMES.length][0]);
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => chart.readColors());
