// Drawing functions that the chart and its frame share.

/** Stroke a path, or with `fill` fill it; colors, widths and the like hold for it alone. */
export function draw(to, { color, width = 1, alpha = 1, dash = [], fill = false }, path) {
  Object.assign(to, { strokeStyle: color, fillStyle: color, lineWidth: width, globalAlpha: alpha, lineJoin: "round" });
  to.setLineDash(dash);
  to.beginPath();
  path(to);
  if (fill) to.fill();
  else to.stroke();
  to.globalAlpha = 1;
}

export function drawLine(to, style, x, y, toX, toY) {
  draw(to, style, () => { to.moveTo(x, y); to.lineTo(toX, toY); });
}

export function fillBox(to, color, alpha, ...box) {
  draw(to, { color, alpha, fill: true }, () => to.rect(...box));
}

/** The lowest and the highest number of several arrays. */
export function rangeOf(arrays) {
  let [low, high] = [Infinity, -Infinity];
  for (const values of arrays) {
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [-1, 1];
}

const MARGIN = 0.07, NEAR_ZERO = 1; // [ranges] room above and below; distance within which zero is shown too

/** A range with a margin, and with zero if that is near. */
export function widen([low, high]) {
  const span = high - low || 0.1 * Math.abs(high) || 1;
  const [from, to] = Math.max(low, -high) <= NEAR_ZERO * span ? [Math.min(low, 0), Math.max(high, 0)] : [low, high];
  const room = MARGIN * (to - from || span);
  return [from - room, to + room];
}
