"""One move of a widget in a real page, timed by the page's own clock, and what it changed there."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Any

import psutil
from lab import Knob
from playwright.sync_api import Page

GIVE_UP = 8_000  # [ms] after which a move has changed nothing
ARM = """([panel, patience]) => {
    const shown = panel.lastElementChild, html = shown.innerHTML, words = shown.innerText;
    const images = () => [...shown.querySelectorAll('img')];
    const late = wait => new Promise(done => setTimeout(() => done('late'), wait));
    const frame = () => new Promise(requestAnimationFrame);
    const drawn = () => images().map(image => {
        const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight);
        const context = canvas.getContext('2d', {willReadFrequently: true});
        context.drawImage(image, 0, 0);
        const {data} = context.getImageData(0, 0, canvas.width, canvas.height);
        return new Uint32Array(data.buffer);
    });
    const before = drawn();
    const changed = () => {
        const after = drawn();
        const same = after.length === before.length
            && after.every((image, i) => image.length === before[i].length);
        if (!same) return 1;
        const count = (image, other) => image.reduce((sum, c, at) => sum + (c !== other[at]), 0);
        const all = after.reduce((sum, image) => sum + image.length, 0);
        return after.reduce((sum, image, i) => sum + count(image, before[i]), 0) / (all || 1);
    };
    const looks = () => drawn().reduce((sum, image) => image.reduce(
        (all, color) => (Math.imul(all, 31) + color) | 0, sum), 0);
    window.redrawn = new Promise(resolve => {
        let begin = null;
        for (const kind of ['keydown', 'click', 'input', 'change'])
            panel.addEventListener(
                kind, event => { begin ??= event.timeStamp; }, {capture: true, once: true});
        const watch = new MutationObserver(async () => {
            if (begin === null || shown.innerHTML === html) return;
            watch.disconnect();
            await Promise.all(images().map(image => image.decode()));
            const decoded = performance.now();
            const unseen = await Promise.race([frame().then(frame), late(500)]) === 'late';
            const end = unseen ? decoded : performance.now();
            resolve({seconds: (end - begin) / 1000, unseen, share: changed(),
                     looks: looks(), words: shown.innerText !== words});
        });
        watch.observe(shown, {subtree: true, childList: true, characterData: true});
        late(patience).then(() => {
            watch.disconnect();
            resolve({seconds: null, unseen: false, share: 0, looks: looks(), words: false});
        });
    });
}"""


@dataclass(frozen=True)
class Move:
    """What came of one move of one widget.

    Args:
        widget: which: the function that draws, and the label.
        to: where it was moved to.
        seconds: until the new picture was on the screen; None where nothing changed.
        work: processor seconds that the lesson's kernel spent on it.
        share: of the picture's pixels that changed.
        looks: a number that two pictures share when all their pixels are the same.
        words: whether any text below the picture changed, or that of the answer.
        unseen: whether the page drew no frame, so that time ends with the decoded picture.
    """

    widget: str
    to: str
    seconds: float | None
    work: float
    share: float
    looks: int
    words: bool
    unseen: bool


Act = Callable[[], object]


def moved(page: Page, panel: Any, act: Act, *, widget: str, to: str) -> Move:
    """Act on a panel, and wait until what came of it is on the screen."""
    page.evaluate(ARM, [panel.element_handle(), GIVE_UP])
    before = _spent()
    act()
    seen = page.evaluate("window.redrawn")
    return Move(widget, to, work=_spent() - before, **seen)


def _spent() -> float:
    """Processor seconds of the kernel; only those of its own, below this very process."""
    times = [process.cpu_times() for process in _kernels()]
    return float(sum(one.user + one.system for one in times))


def _kernels() -> list[psutil.Process]:
    below = psutil.Process().children(recursive=True)
    return [process for process in below if "ipykernel_launcher" in process.cmdline()]


def turned(page: Page, panel: Any, knob: Knob, *, name: str) -> Iterator[Move]:
    """All moves of a knob, which is back where it was afterwards."""
    _, begun, _ = knob.place
    for to, act in chain(_there(knob), _back(knob, begun)):
        yield moved(page, panel, act, widget=name, to=to)


def answered(page: Page, box: Any) -> Iterator[Move]:
    """All answers of a question that says something to them; none to a guess, which does not."""
    if not box.locator("> .widget-html").last.evaluate("words => !words.nextElementSibling"):
        return
    name = box.locator(".widget-html-content").first.inner_text()[:50]
    for choice in box.locator("label:has(> input[type=radio])").all():
        yield moved(page, box, choice.locator("input").check, widget=name, to=choice.inner_text())
    for line in box.locator("input[type=text]").all():
        line.fill("1")
        yield moved(page, box, lambda line=line: line.press("Enter"), widget=name, to="1")


def _there(knob: Knob) -> Iterator[tuple[str, Act]]:
    """What a knob is moved to, and how; a menu or a checkbox ends where it began."""
    first, now, last = knob.place
    if knob.kind == "slider":
        there, back = ("ArrowRight", "ArrowLeft") if now < last else ("ArrowLeft", "ArrowRight")
        end = "End" if last - now >= now - first else "Home"
        yield "a step", lambda: knob.grip.press(there)
        yield "a step back", lambda: knob.grip.press(back)
        yield f"its {'last' if end == 'End' else 'first'}", lambda: knob.grip.press(end)
    elif knob.kind == "menu":
        names = knob.grip.locator("option").all_inner_texts()
        for place in [*(place for place in range(len(names)) if place != now), now]:
            yield names[place].strip(), lambda place=place: knob.grip.select_option(index=place)
    else:
        yield "a click", knob.grip.click
        if knob.kind == "checkbox":
            yield "a click back", knob.grip.click


def _back(knob: Knob, begun: float) -> Iterator[tuple[str, Act]]:
    """How a slider gets back: by the number beside it, or by steps where that is no number."""
    if knob.kind != "slider":
        return
    beside = knob.grip.locator("xpath=ancestor::*[contains(@class, 'widget-inline-hbox')]")
    number = beside.locator(".widget-readout")
    if number.inner_text() in {f"{knob.place[1]:.{digits}f}" for digits in range(4)}:
        yield "typed back", lambda: (number.fill(f"{begun:g}"), number.press("Enter"))
    while round(away := knob.place[1] - begun, 6):
        yield "a step back", lambda: knob.grip.press("ArrowLeft" if away > 0 else "ArrowRight")
