// Input on the chart: wheel, mouse, touch and keyboard.

const ZOOM = 1.25; // factor per step of a key or a wheel
const CURSOR_STEP = 10; // [samples] step of the cursor with Shift
const STILL = 4; // [px] a shorter drag marks nothing
const EDGE = 8; // [px] distance within which an edge of a span can be dragged

/** Add the event handlers that move, zoom and mark a chart. */
export function listen(chart) {
  const { moving } = chart;
  const pointers = new Map();
  let drag = null; // the current action of the pointer: {kind, x, run, anchor}
  moving.addEventListener("wheel", (event) => {
    if (!chart.timeline) return;
    event.preventDefault();
    if (Math.abs(event.deltaX) > Math.abs(event.deltaY)) chart.pan(event.deltaX);
    else chart.zoomAt(event.offsetX, Math.exp(0.0016 * event.deltaY));
  }, { passive: false });
  moving.addEventListener("pointerdown", (event) => {
    if (!chart.timeline) return;
    moving.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, event);
    drag = beginDrag(chart, event);
    if (drag.kind === "overview") chart.centerOn(event.offsetX);
  });
  moving.addEventListener("pointermove", (event) => {
    if (!chart.timeline) return;
    const before = pointers.get(event.pointerId);
    if (!before || event.pointerType !== "mouse" || drag.kind === "mark") {
      chart.setCursor(chart.timeline.sampleAt(chart.placeOfX(event.offsetX)));
    }
    if (!before) {
      moving.style.cursor = chart.showsSignals && edgeAt(chart, event.offsetX) ? "ew-resize" : "";
      return;
    }
    const others = [...pointers.values()].filter((one) => one.pointerId !== event.pointerId);
    pointers.set(event.pointerId, event);
    if (others.length) {
      const [was, is] = [before, event].map((one) => Math.max(Math.abs(one.offsetX - others[0].offsetX), 20));
      chart.zoomAt(0.5 * (event.offsetX + others[0].offsetX), was / is);
    } else if (drag.kind === "overview") chart.centerOn(event.offsetX);
    else if (drag.kind === "mark") dragSpan(chart, drag, event.offsetX);
    else chart.pan(before.offsetX - event.offsetX);
  });
  for (const name of ["pointerup", "pointercancel"]) {
    moving.addEventListener(name, (event) => pointers.delete(event.pointerId));
  }
  moving.addEventListener("dblclick", () => chart.showAll());
  moving.addEventListener("keydown", (event) => {
    if (!chart.timeline || event.ctrlKey || event.metaKey || event.altKey) return;
    if (pressKey(chart, event.key, event.shiftKey)) event.preventDefault();
  });
}

/** The action that a pointer starts when it is pressed. */
function beginDrag(chart, { offsetX, offsetY, shiftKey }) {
  if (offsetY > chart.overview.top - 4) return { kind: "overview" };
  if (!chart.showsSignals) return { kind: "pan" };
  const edge = edgeAt(chart, offsetX);
  if (edge) return { kind: "mark", x: null, ...edge };
  if (chart.dragMarks === shiftKey) return { kind: "pan" };
  const { run, sample } = chart.timeline.sampleAt(chart.placeOfX(offsetX));
  return { kind: "mark", x: offsetX, run, anchor: sample };
}

/** The marked span with an edge at x: its run, and the sample of its other edge. */
function edgeAt(chart, x) {
  for (const [run, span] of chart.spans) {
    for (const [k, sample] of span.entries()) {
      const at = chart.xOf(chart.timeline.placeOf(run, chart.runs[run].time[sample]));
      if (Math.abs(at - x) < EDGE) return { run, anchor: span[1 - k] };
    }
  }
  return null;
}

function dragSpan(chart, drag, x) {
  if (drag.x !== null && Math.abs(x - drag.x) < STILL) return;
  drag.x = null;
  const sample = chart.timeline.sampleIn(drag.run, chart.placeOfX(x));
  chart.setSpan(drag.run, [Math.min(drag.anchor, sample), Math.max(drag.anchor, sample)]);
}

function pressKey(chart, key, shift) {
  const step = shift ? CURSOR_STEP : 1;
  const { cursor } = chart;
  const middle = cursor
    ? chart.xOf(chart.timeline.placeOf(cursor.run, chart.runs[cursor.run].time[cursor.sample]))
    : 0.5 * (chart.left + chart.right);
  switch (key) {
    case "ArrowLeft": return chart.stepCursor(-step);
    case "ArrowRight": return chart.stepCursor(step);
    case "+": case "=": case "ArrowUp": chart.zoomAt(middle, 1 / ZOOM); return true;
    case "-": case "_": case "ArrowDown": chart.zoomAt(middle, ZOOM); return true;
    case "0": case "Escape": chart.showAll(); return true;
    case "PageDown": case "PageUp": return chart.stepRun(key === "PageDown" ? 1 : -1);
    case "Home": chart.setCursor({ run: 0, sample: 0 }); return true;
    case "End": chart.setCursor({ run: chart.runs.length - 1, sample: chart.runs.at(-1).time.length - 1 }); return true;
    case "s": case "e": case "Delete": case "Backspace": return markAtCursor(chart, key);
    default: return false;
  }
}

/** Begin or end the span of the cursor's run at the cursor, or remove it. */
function markAtCursor(chart, key) {
  if (!chart.showsSignals || !chart.cursor) return false;
  const { run, sample } = chart.cursor;
  const [first, last] = chart.spans.get(run) ?? [0, chart.runs[run].time.length - 1];
  if (key === "s") chart.setSpan(run, [sample, Math.max(last, sample)]);
  else if (key === "e") chart.setSpan(run, [Math.min(first, sample), sample]);
  else chart.setSpan(run, null);
  return true;
}
