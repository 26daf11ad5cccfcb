// The time spans that the user marks in a log, in the text format of an exercise.

const FINEST = 100; // times are rounded to 1/FINEST s

/** The text to paste: the test of each span, and its seconds since the test began. */
export function writeSpans({ before, span, between, after }, { name, runs }, spans) {
  const log = name.replace(/\.[^.]*$/, "");
  const fill = (pattern, words) => pattern.replace(/\{(\w+)\}/g, (whole, key) => words[key] ?? whole);
  const parts = [...spans.keys()].sort((a, b) => a - b).map((run) => {
    const { test } = runs[run];
    const [begin, end] = secondsOf(runs[run], spans.get(run));
    return fill(span, { log, test, key: test.replaceAll("-", "_"), begin, end });
  });
  return parts.length ? fill(before, { log }) + parts.join(between) + after : "";
}

/** Start and end in seconds since the test began, rounded outward to contain both samples. */
function secondsOf({ time }, [first, last]) {
  const since = (sample) => FINEST * (time[sample] - time[0]);
  return [Math.floor(since(first) + 0.01), Math.ceil(since(last) - 0.01)].map((one) => (one / FINEST).toFixed(2));
}
