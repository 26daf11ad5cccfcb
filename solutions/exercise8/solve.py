"""Exercise 8, answered: cut at the stop, drop the standstill, outvote single readings.

What is looked for is what a person sees on a plot; nothing here knows how the log was made.
"""

from pathlib import Path

import numpy as np

from sim.core.log import Log, Run
from sim.core.units import find_unit
from sim.io import read

STANDS = 0.02  # [share of the way] by which a position may move, and still stand
BEFORE = 0.1  # [s] cut before the stop
LEAST = 0.2  # [s] against it that are no accident


def solve(exercise: Path, data: Path) -> dict[str, str]:
    """The files a learner would hand in.

    Args:
        exercise: the exercise's folder, with the file to fill in.
        data: the learner's own data.

    Returns:
        File name -> its text.
    """
    log = read(data / "log.wpilog")
    text = (exercise / "answers.toml").read_text(encoding="utf-8")
    lines = {run.test.replace("-", "_"): f'"{_select_samples(run)}"' for run in log.runs}
    lines |= {"threshold": f"{_choose_threshold(log) / find_unit(log.units).si:.4g}", "median": "3"}
    for name, value in lines.items():
        text = text.replace(f'{name} = ""', f"{name} = {value}")
    return {"answers.toml": text}


def _select_samples(run: Run) -> str:
    """From the beginning until shortly before the position stands for good, voltage or not."""
    away = np.abs(run.position - run.position[-1])
    moves = np.flatnonzero(away > STANDS * np.ptp(run.position))
    stops = float(run.time[moves[-1]] - run.time[0])
    if run.time[-1] - run.time[0] - stops < LEAST:
        return "all"
    return f"0 to {stops - BEFORE:.2f}"


def _choose_threshold(log: Log) -> float:
    """More than the velocity trembles by before a ramp moves."""
    rests = []
    for run in log.runs:
        if run.kind == "quasistatic":
            away = np.abs(run.position - run.position[0]) > 1e-4 * np.ptp(run.position)
            rests.append(np.abs(run.velocity[: int(np.argmax(away))]))
    return 1.1 * max(float(rest.max()) for rest in rests)
