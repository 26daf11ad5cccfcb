// Ticks of an axis, for the plots of an animation and for the page of `sysid open`.

/** About so many round numbers between two values, for ticks. */
export function roundTicks(low, high, count) {
  const raw = (high - low) / Math.max(count, 1);
  const power = 10 ** Math.floor(Math.log10(raw || 1));
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= 0.7 * raw) ?? power;
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) ticks.push(k * step);
  return ticks;
}

/** The text of a tick, without rounding errors, with a minus sign (−). */
export function short(value) {
  return String(Number(value.toPrecision(6))).replace("-", "−");
}
