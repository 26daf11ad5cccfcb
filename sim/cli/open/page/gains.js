// The gains: sliders, simulation error, feedback, robot code.

import { addressOf, askLog } from "./api.js";
import { figure, make, sentence } from "./elements.js";
import { modelQuery, shownLog } from "./logs.js";
import { at, copy } from "./page.js";
import { simulate } from "./simulation.js";
import { Sliders } from "./sliders.js";
import { chart, showCursor } from "./stage.js";
import { showDoubts } from "./verdict.js";

const MOST_FLOORS = 10; // [times the sensor noise] error that fills its bar

export const sliders = new Sliders(at("sliders"), moveGains);

export function showFit() {
  const log = shownLog();
  const { fit, fitRefused } = log;
  at("paste").disabled = at("feedback").disabled = !fit;
  at("reset").hidden = true;
  at("report").removeAttribute("href");
  at("report").setAttribute("aria-disabled", String(!fit));
  showDoubts();
  if (!fit) {
    for (const id of ["sliders", "meter"]) at(id).replaceChildren();
    document.querySelector(".legend .without").hidden = true;
    at("verdict").textContent = fitRefused ? sentence(fitRefused) : log.summary.compiles
      ? "The simulation is compiled first. That is done once, and takes about twenty seconds." : "";
    return;
  }
  nameReport();
  sliders.show(fit.gains, log.gains, { fixed: Boolean(fit.tracks) });
  log.moved = sliders.isMoved;
  showSimulation(log);
  chart.redraw();
}

function moveGains(values) {
  const log = shownLog();
  if (!log?.fit) return;
  log.gains = values;
  if (log.moved !== sliders.isMoved) { log.moved = sliders.isMoved; showDoubts(); }
  if (moveGains.waiting) return;
  moveGains.waiting = requestAnimationFrame(() => {
    moveGains.waiting = 0;
    if (log === shownLog()) showSimulation(log);
  });
}

function showSimulation(log) {
  const error = simulate(log, log.gains);
  const without = log.fit.tracks ? log.plainSimulated : [];
  chart.setSimulation(log.simulated, log.fit.noise === null ? null : log.fit.noise / log.summary.units.si, without);
  document.querySelector(".legend .without").hidden = !without.length;
  showMeter(log, error);
  showCursor(chart.cursor);
  at("reset").hidden = !sliders.isMoved;
}

function showMeter(log, error) {
  if (error === null) {
    const why = log.fit.tracks
      ? "The search took the mean of several motors, so the curves of this model are not drawn."
      : "Nothing moves with these gains: kV and kA have to be above zero.";
    at("meter").replaceChildren(make("p", "quiet", why));
    return;
  }
  const { si, symbol } = log.summary.units;
  const floors = (error * si) / log.fit.noise;
  const gap = make("p", "gap", make("b", "", floors.toPrecision(floors < 10 ? 2 : 3)), " × sensor noise, ",
    make("b", "", (100 * error / log.fit.top).toPrecision(2)), "\u00a0% of top speed");
  const ratio = error / log.fitError;
  const moved = log.moved ? `, ${ratio >= 10 ? Math.round(ratio) : ratio.toFixed(2)} × that of the fit` : "";
  const bar = make("div", `bar-of-error${floors > 2 ? " far" : ""}`);
  bar.style.setProperty("--share", Math.min(1, floors / MOST_FLOORS));
  at("meter").replaceChildren(gap, make("p", "quiet", `simulation error ${figure(error)} ${symbol}/s${moved}`), bar);
}

/** The query for the chosen model, with the gains that the user moved. */
function movedQuery(log) {
  const moved = log.fit.gains.map(({ name, value }) => [name, log.gains[name] === value ? undefined : log.gains[name]]);
  return { ...modelQuery(log), ...Object.fromEntries(moved) };
}

/** Let the page be saved as it is seen now. */
function nameReport() {
  const log = shownLog();
  Object.assign(at("report"), { href: addressOf(log.id, "report.html", { ...movedQuery(log), story: log.search?.story && 1 }), download: `${log.name}.html` });
}

/** Robot code with the gains; those that the user moved replace those of the fit. */
async function showCode() {
  const log = shownLog();
  const asked = showCode.asked = {}; // an answer that a later question overtakes is not shown
  const query = { ...movedQuery(log), language: at("language").value, season: at("season").value, radius: at("radius").value.replace(",", ".") };
  at("code-text").textContent = "Writing…";
  at("copy").disabled = true;
  const [text, problem] = await askLog(log.id, "code", query).then(({ code }) => [code], (refusal) => [sentence(refusal), refusal]);
  if (asked !== showCode.asked) return;
  at("code-text").textContent = text;
  at("copy").disabled = Boolean(problem); // a refusal is no code
  at("radius-row").hidden = problem ? problem.asks !== "radius" : !query.radius;
}

at("reset").addEventListener("click", () => sliders.reset());
at("report").addEventListener("click", nameReport);
at("paste").addEventListener("click", async () => { if (showCode.log !== shownLog()) at("radius").value = ""; showCode.log = shownLog(); await showCode(); at("code").showModal(); });
at("copy").addEventListener("click", () => copy(at("code-text")));
for (const id of ["language", "season", "radius"]) at(id).addEventListener("input", showCode);
