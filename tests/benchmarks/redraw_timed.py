"""One move of a widget in a real page, timed by the page's own clock, and what it changed there."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from lab import OFTEN, Knob
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
    window.before = html;
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
                     words: shown.innerText !== words});
        });
        watch.observe(shown, {subtree: true, childList: true, characterData: true});
        late(patience).then(() => {
            watch.disconnect();
            resolve({seconds: null, unseen: false, share: 0, words: false});
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
        share: of the picture's pixels that changed.
        words: whether any text below the picture changed, or that of the answer.
        unseen: whether the page drew no frame, so that time ends with the decoded picture.
    """

    widget: str
    to: str
    seconds: float | None
    share: float
    words: bool
    unseen: bool


Act = Callable[[], object]


def moved(page: Page, panel: Any, act: Act, *, widget: str, to: str) -> Move:
    """Act on a panel, and wait until what came of it is on the screen."""
    page.evaluate(ARM, [panel.element_handle(), GIVE_UP])
    act()
    return Move(widget, to, **page.evaluate("window.redrawn"))


def turned(page: Page, panel: Any, knob: Knob, *, name: str) -> Iterator[Move]:
    """All moves of a knob, which is back where it was afterwards."""
    panel.locator("> *").last.evaluate("shown => { window.first = shown.innerHTML; }")
    _, begun, _ = knob.place
    for to, act in _acts(knob):
        yield moved(page, panel, act, widget=name, to=to)
    if knob.kind == "slider":
        _put_back(knob, begun)
    if knob.kind != "button":
        page.wait_for_function(
            "panel => panel.lastElementChild.innerHTML === window.first",
            arg=panel.element_handle(),
            polling=OFTEN,
        )


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


def _acts(knob: Knob) -> Iterator[tuple[str, Act]]:
    """What a knob is moved to, and how; what it is moved back to is a move, too."""
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


def _put_back(knob: Knob, place: float) -> None:
    """A slider to where it was: by the number beside it, or by steps where that is a name."""
    slider = knob.grip.locator("xpath=ancestor::*[contains(@class, 'widget-inline-hbox')]")
    number = slider.locator(".widget-readout")
    number.fill(f"{place:g}")
    number.press("Enter")
    while round(away := knob.place[1] - place, 6):
        knob.grip.press("ArrowLeft" if away > 0 else "ArrowRight")
