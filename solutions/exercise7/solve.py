"""Exercise 7, answered: what the bench's own detective says, with what helps against it."""

from pathlib import Path

from sim.core.log import Log
from sim.inspect.detect_faults import inspect
from sim.inspect.faults import FAULTS
from sim.io import read

HELPS = {
    "encoder-slip": "rerun",
    "brownout": "rerun",
    "hard-stop": "trim",
    "loop-overrun": "rerun",
    "noisy-standstill": "filter",
    "stuck-sensor": "rerun",
    "wheel-slip": "rerun",
}


def solve(exercise: Path, data: Path) -> dict[str, str]:
    """The files a learner would hand in.

    Args:
        exercise: the exercise's folder, with the file to fill in.
        data: the learner's own data.

    Returns:
        File name -> its text.
    """
    text = (exercise / "answers.toml").read_text(encoding="utf-8")
    for path in sorted(data.glob("*.wpilog")):
        text = text.replace(f'{path.stem} = ""', f'{path.stem} = "{_write_line(path)}"')
    return {"answers.toml": text}


def _write_line(path: Path) -> str:
    """What is wrong with one log, in the words of the exercise."""
    log = read(path)
    said = []
    found = inspect(log).damages
    for name in dict.fromkeys(one.fault for one in found):
        where = [one.where for one in found if one.fault == name]
        help_with = HELPS.get(name, "fix-config")
        if not FAULTS[name].whole:
            (part,) = where
            said.append(
                f"{name}, {part.test}, {_measure_time_since(log, part.run, part.start):.2f} to "
                f"{_measure_time_since(log, part.run, part.end):.2f}, {help_with}"
            )
            continue
        said.append(f"{name}, {_format_tests([part.test for part in where])}, {help_with}")
    return " + ".join(said) or "clean"


def _measure_time_since(log: Log, run: int | None, moment: float) -> float:
    """[s] since the test began."""
    return moment - float(log.runs[run or 0].time[0])


def _format_tests(names: list[str]) -> str:
    """All of them by one word, or each by its name."""
    return "whole" if len(names) == 4 else ", ".join(names)
