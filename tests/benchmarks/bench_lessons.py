"""How long a learner waits: each lesson, its slowest cell, and how smoothly its figures move.

    python tests/benchmarks/bench_lessons.py [NN ...]

Cells are run in this process, one after another, as JupyterLab does without its drawing. Then
Chromium shows each figure, while its first slider or menu moves all the time: pictures a second.
Aims: a lesson under 60 s, a cell at most 5 s, a figure at least 20 pictures a second.
"""

import contextlib
import io
import os
import re
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from chromium import launched  # noqa: E402 - found beside the tests
from IPython.core.interactiveshell import InteractiveShell  # noqa: E402

from sim.plot.animation import Animation  # noqa: E402

# What moves: the first slider, the first menu, or the cursor of the time.
DRAG = """async (figure) => {
    const [knob] = ['.motion-knobs input', '.motion-knobs select', '.motion-clock input']
        .map(name => figure.querySelector(name)).filter(Boolean);
    if (!knob) return null;
    const [began, before] = [performance.now(), figure.animation.pictures];
    for (let k = 0; performance.now() - began < 1000; k++) {
        if (knob.tagName === 'SELECT') knob.selectedIndex = k % knob.options.length;
        else knob.value = +knob.min + (0.5 + 0.4 * Math.sin(k / 5)) * (knob.max - knob.min);
        knob.dispatchEvent(new Event(knob.tagName === 'SELECT' ? 'change' : 'input'));
        await new Promise(requestAnimationFrame);
    }
    return (figure.animation.pictures - before) / ((performance.now() - began) / 1000);
}"""


def list_cells(text: str) -> list[str]:
    """The code cells of a lesson's text."""
    parts = re.split(r"^# %%(.*)$", text, flags=re.MULTILINE)
    return [code for mark, code in zip(parts[1::2], parts[2::2], strict=True) if not mark.strip()]


def run_lesson(path: Path) -> tuple[str, list[Animation]]:
    """Run one lesson: its times in words, and its figures that are the last value of a cell."""
    shell, figures = InteractiveShell(), []
    os.chdir(path.parent)
    slowest, begin = (0.0, ""), time.perf_counter()
    for code in list_cells(path.read_text(encoding="utf-8")):
        before = time.perf_counter()
        with contextlib.redirect_stdout(io.StringIO()):
            result = shell.run_cell(code)
        result.raise_error()
        if isinstance(result.result, Animation):
            figures.append(result.result)
        slowest = max(slowest, (time.perf_counter() - before, code.strip().splitlines()[0][:40]))
    whole = time.perf_counter() - begin
    return f"{path.stem:26} {whole:5.1f} s   slowest cell {slowest[0]:4.1f} s", figures


def measure_rates(browser: Any, figures: list[Animation]) -> list[int]:
    """Pictures a second of each figure."""
    page = browser.new_page(viewport={"width": 1280, "height": 900}, reduced_motion="reduce")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "figures.html")
        html = "".join(figure.html for figure in figures)
        path.write_text(f'<!DOCTYPE html><meta charset="utf-8">{html}', encoding="utf-8")
        page.goto(path.as_uri())
        shown = page.locator("figure.motion").all()
        rates = []
        for figure in shown:
            figure.scroll_into_view_if_needed()
            rate = figure.evaluate(DRAG)
            rates += [] if rate is None else [round(rate)]  # a figure that only clicks has no rate
    page.close()
    return rates


def main() -> None:
    """Measure the lessons asked for, or all."""
    asked = tuple(sys.argv[1:])
    with launched() as browser:
        for path in sorted((ROOT / "lessons").glob("*.py")):
            if not asked or path.name.startswith(asked):
                words, figures = run_lesson(path)
                print(f"{words}   pictures/s {measure_rates(browser, figures)}")


if __name__ == "__main__":
    main()
