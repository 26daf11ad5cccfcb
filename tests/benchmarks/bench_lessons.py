"""How long a learner waits: each lesson from top to bottom, its slowest cell, its slowest redraw.

    python tests/benchmarks/bench_lessons.py [NN ...]

Cells are run in this process, one after another, as JupyterLab does without its drawing. A redraw
is one knob moved once: the function of each `show_interactive` is called with other values of each
knob.
Aims: a lesson under 60 s, a cell at most 5 s, a redraw at most 1 s.
"""

import contextlib
import io
import os
import re
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from IPython.core.interactiveshell import InteractiveShell

import sim.plot

LESSONS = Path(__file__).resolve().parents[2] / "lessons"
redraws: list[tuple[float, str]] = []


def timed(draw: Callable[..., Any], **knobs: Any) -> Any:
    """What `show_interactive` does, and how long each knob's move takes."""
    shown = show_interactive(draw, **knobs)
    for name, knob in knobs.items():
        asked = {one: other.value for one, other in knobs.items()}
        for value in moved(knob):
            begin = time.perf_counter()
            with contextlib.suppress(sim.Refusal):
                drawn = draw(**{**asked, name: value})
                pictures = [drawn] if isinstance(drawn, sim.plot.Picture) else drawn
                "".join(picture.html for picture in pictures)
            redraws.append((time.perf_counter() - begin, f"{draw.__name__}({name}={value!r})"))
    return shown


def moved(knob: Any) -> list[Any]:
    """Other values of a knob: the ends of a slider, the first and last of a menu."""
    if hasattr(knob, "options"):
        values = [one[1] if isinstance(one, tuple) else one for one in knob.options]
        return [values[0], values[-1]]
    if hasattr(knob, "max"):
        return [knob.min, knob.max]
    return [not knob.value] if isinstance(knob.value, bool) else []


def cells(text: str) -> list[str]:
    """The code cells of a lesson's text."""
    parts = re.split(r"^# %%(.*)$", text, flags=re.MULTILINE)
    return [code for mark, code in zip(parts[1::2], parts[2::2], strict=True) if not mark.strip()]


def lesson(path: Path) -> None:
    """Run one lesson and print its times."""
    shell = InteractiveShell()
    redraws.clear()
    os.chdir(path.parent)
    slowest, begin = (0.0, ""), time.perf_counter()
    for code in cells(path.read_text(encoding="utf-8")):
        before, drawing = time.perf_counter(), sum(seconds for seconds, _ in redraws)
        with contextlib.redirect_stdout(io.StringIO()):
            result = shell.run_cell(code)
        result.raise_error()
        drawing = sum(seconds for seconds, _ in redraws) - drawing
        spent = time.perf_counter() - before - drawing
        slowest = max(slowest, (spent, code.strip().splitlines()[0][:40]))
    whole = time.perf_counter() - begin - sum(seconds for seconds, _ in redraws)
    worst = max(redraws, default=(0.0, "no knobs"))
    print(
        f"{path.stem:28} {whole:6.1f} s   cell {slowest[0]:4.1f} s   {len(redraws):3} redraws, "
        f"slowest {worst[0]:4.2f} s  {worst[1][:60]}"
    )


def main() -> None:
    """Time the lessons asked for, or all."""
    asked = tuple(sys.argv[1:])
    print(f"load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "")
    for path in sorted(LESSONS.glob("*.py")):
        if not asked or path.name.startswith(asked):
            lesson(path)


show_interactive = sim.plot.show_interactive
sim.plot.show_interactive = timed

if __name__ == "__main__":
    main()
