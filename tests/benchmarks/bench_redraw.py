"""How long a learner waits for a picture: every widget of every lesson, moved in a real browser.

    python tests/benchmarks/bench_redraw.py [--times N] [NN ...]

Each lesson is opened in JupyterLab, run from top to bottom, and every knob is moved: a slider one
step, back, and to its farther end; a menu to each of its options; a checkbox there and back. Then
it is put back, and the next is moved. Time runs, by the page's own clock, from the event of the key
or click until the new picture is decoded and two frames have begun (the first one paints it).
Answers to questions are given, too, and wait for their words. With ``--times`` all of this is done
N times, and the figure of a move is its median. Aim: 1 s. "Computing" is processor time of the
lesson's kernel; the rest of the waiting is the browser, or a machine busy with other things, whose
load stands beside it.

What changes no pixel of its picture is named: a knob that does so at none of its moves is a flaw,
and one that changes hardly any is worth a look.
"""

import argparse
import os
import sys
import tempfile
import time
from itertools import groupby
from pathlib import Path
from statistics import median
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # in the lessons' kernels, too

from playwright.sync_api import Browser, Page, sync_playwright

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import lab
from redraw_timed import Move, answered, turned

AIM = 1.0  # [s]
HARDLY = 0.001  # of the pixels: less than a line across the picture that has moved


def loaded() -> str:
    """How busy the machine is with this and all else, where it says so."""
    return f"load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "load unknown"


def all_moves(page: Page, notebook: Path, *, times: int) -> tuple[list[Move], list[Move]]:
    """Every move of every knob, and every answer to a question, so many times."""
    turns, answers = [], []
    boxes = page.locator(".jp-Notebook .widget-vbox").filter(has_not=page.locator("img")).all()
    for _ in range(times):
        for panel in lab.panels(page):
            drawn_by = lab.drawn_by(panel, notebook)
            for knob in lab.knobs(panel):
                turns += turned(page, panel, knob, name=f"{drawn_by}: {knob.name}")
        for box in boxes:
            answers += answered(page, box)
    return turns, answers


def typical(moves: list[Move]) -> list[Move]:
    """Of each move that was made several times the one in the middle."""

    def key(move: Move) -> tuple[str, str]:
        return move.widget, move.to

    found = []
    for _, same in groupby(sorted(moves, key=key), key=key):
        ranked = sorted(same, key=lambda move: move.seconds or 0.0)
        found.append(ranked[len(ranked) // 2])
    return found


def line(moves: list[Move], *, of: str) -> str:
    """How many, the median, and the slowest with its name."""
    timed = [move for move in moves if move.seconds]
    if not timed:
        return f"    no {of}"
    many = f"{len({move.widget for move in moves}):2} {of}, {len(moves):3} moves"
    middle = median(move.seconds or 0.0 for move in timed)
    slowest = max(timed, key=lambda move: move.seconds or 0.0)
    return f"    {many}: median {middle:4.2f} s, slowest {describe_move(slowest)}"


def describe_move(move: Move) -> str:
    """One move: how long, how much of it the lesson computed, and which."""
    return f"{move.seconds:4.2f} s (computing {move.work:4.2f} s)  {move.widget} → {move.to}"


def flaws(turns: list[Move], answers: list[Move]) -> list[str]:
    """What took too long, and what changed nothing that one sees."""
    found = [
        f"over {AIM:g} s: {describe_move(move)}"
        for move in [*turns, *answers]
        if move.seconds and move.seconds > AIM
    ]
    for name in dict.fromkeys(move.widget for move in turns):
        found += unseen(name, [move for move in turns if move.widget == name])
    found += [f"no words come: {move.widget} → {move.to}" for move in answers if not move.words]
    frameless = sum(move.unseen for move in [*turns, *answers])
    return found + ([f"{frameless} moves without a frame, timed until decoded"] * (frameless > 0))


def unseen(name: str, moves: list[Move]) -> list[str]:
    """What of one knob's moves nobody sees in the picture."""
    blind = [move for move in moves if not move.share]
    which = ", ".join(f"{move.to}{' (words only)' if move.words else ''}" for move in blind)
    most = max(move.share for move in moves)
    if not most:
        return [f"KNOB THAT CHANGES NO PIXEL: {name}: {which}"]
    found = [f"no pixel changes: {name} → {which}"] if blind else []
    if most < HARDLY:
        found += [f"hardly seen: {name}: at most {most:.2%} of the pixels change"]
    alike: dict[int, list[str]] = {}
    for move in moves:
        if not move.to.endswith(("back", "step")):  # back is meant to look as before
            alike.setdefault(move.looks, []).append(move.to)
    return found + [f"alike: {name} → {' = '.join(to)}" for to in alike.values() if len(to) > 1]


def lesson(notebook: Path, browser: Browser, *, times: int) -> None:
    """Open, run and turn one lesson, and print its figures."""
    with tempfile.TemporaryDirectory() as folder, lab.serving(Path(folder)) as address:
        page = browser.new_page(viewport=lab.SCREEN)
        page.set_default_timeout(lab.PATIENCE)
        begin = time.perf_counter()
        lab.run_all(page, address.format(name=notebook.name))
        opened = time.perf_counter() - begin
        errors = len(lab.outputs(page, "error"))
        turns, answers = (typical(all_) for all_ in all_moves(page, notebook, times=times))
        page.close()
    print(f"{notebook.stem:28} opened and run {opened:5.1f} s, {errors} errors   {loaded()}")
    print(line(turns, of="knobs"))
    print(line(answers, of="questions"))
    for flaw in flaws(turns, answers):
        print(f"      {flaw}")
    sys.stdout.flush()


def main() -> None:
    """Time the lessons asked for, or all."""
    parser = argparse.ArgumentParser(description="Move every widget of every lesson.")
    parser.add_argument("lessons", nargs="*", help="numbers: 00 09; all where none is given")
    parser.add_argument("--times", type=int, default=1, help="how often each move is made")
    asked: Any = parser.parse_args()
    print(f"aim {AIM:g} s   {loaded()}   {os.cpu_count()} cores")
    with sync_playwright() as driver:
        found = lab.installed_browser()
        if found is None:
            sys.exit(f"no browser found: install one of {', '.join(lab.BROWSERS)}")
        browser = driver.chromium.launch(executable_path=found, args=lab.FLAGS, headless=True)
        for notebook in lab.LESSONS:
            if not asked.lessons or notebook.name.startswith(tuple(asked.lessons)):
                lesson(notebook, browser, times=asked.times)
        browser.close()


if __name__ == "__main__":
    main()
