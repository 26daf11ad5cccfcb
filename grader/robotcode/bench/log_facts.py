"""Facts of a run: the robot's own log compared with what the simulation recorded.

A learner's code may have written all of it: it is read as JSON and as a WPILOG, from plain files of
an ordinary size, and what is told on is one line.
"""

import json
import math
import re
import stat
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from grader.isolation import format_one_line
from grader.robotcode.bench.run_facts import (
    ButtonPress,
    DrivenMotor,
    LoggedMotor,
    RunFacts,
    RunOutcome,
)
from grader.robotcode.bench.run_routine_child import LONGEST
from grader.robotcode.bench.sandboxed_run import LARGEST
from grader.robotcode.bench.season import explain_other_season
from sim.core.errors import Refusal
from sim.core.log import Array, Log, Run
from sim.core.units import find_unit
from sim.io import read
from sim.io.formats.wpilog.contents import read_contents
from sim.io.formats.wpilog.records import load_records

STATE = "sysid-test-state-"
NEEDED = {"voltage", "position", "velocity"}
MOST_MOTORS = 20  # in a log: a roboRIO has so many PWM channels
MOST_PRESSES = 200  # of buttons: some fifty, in test mode and out of it
MOVED = 0.2  # [any unit] less motion than this tells nothing
AWAKE = 0.5  # [V] below this the steps of a PWM signal, 20 mV, count too much
WHOLE = 10.0  # [V] above this the battery has no more to give
FOLLOWS = 0.02  # relative misfit up to which a position follows an encoder
LOW = (0.85, 1.15)  # [s] of a dynamic test: the battery is low, and nothing jumps

NOT_OURS = (ValueError, KeyError, TypeError, IndexError, AttributeError, ArithmeticError)


@dataclass(frozen=True, eq=False)
class BenchTrace:
    """The simulation's own record of every loop of a test.

    Args:
        test: (n,) name of the test.
        time, asked: (n,) [s], [V].
        applied: (n, motors) [V].
        distance: (n, encoders) in the program's own unit.
    """

    test: NDArray[np.str_]
    time: Array
    asked: Array
    applied: Array
    distance: Array

    def during(self, run: Run) -> "BenchTrace":
        """The loops of one test, at the log's own samples."""
        rows = np.flatnonzero(self.test == run.test)
        rows = rows[np.clip(np.searchsorted(self.time[rows], run.time - 1e-4), 0, rows.size - 1)]
        return BenchTrace(
            self.test[rows],
            self.time[rows],
            self.asked[rows],
            self.applied[rows],
            self.distance[rows],
        )


def read_facts(folder: Path, file: Path, *, ended: bool, seconds: float) -> RunFacts:
    """Read what the child left behind, and compare the robot's log with the simulation.

    Args:
        folder: where the child left its results.
        file: the learner's file.
        ended: whether the child ended by itself.
        seconds: how long it was given.
    """
    try:
        seen = json.loads(_left(folder / "seen.json").read_text(encoding="utf-8"))
        return _facts(seen, folder, file)
    except FileNotFoundError:
        return _gone(folder, file, ended=ended, seconds=seconds)
    except (*NOT_OURS, RecursionError):
        return RunFacts(RunOutcome.CANNOT, "the run left no result")


def _left(path: Path) -> Path:
    """A file that was left behind, if it is a plain one of an ordinary size.

    Raises:
        FileNotFoundError: there is none.
        ValueError: it is something else.
    """
    about = path.lstat()
    if not stat.S_ISREG(about.st_mode) or about.st_size > LARGEST:
        raise ValueError(f"{path.name} is none of ours")
    return path


def _gone(folder: Path, file: Path, *, ended: bool, seconds: float) -> RunFacts:
    """The child left no word: it hung, or ended itself."""
    try:
        where = _left(folder / "endless.txt").read_text(encoding="utf-8", errors="replace")
    except (FileNotFoundError, ValueError):
        where = ""
    if ended and not where:
        return RunFacts(
            RunOutcome.CRASHED, "your code ended the robot program in the middle of a test"
        )
    stack = re.findall(r'File "(.*)", line (\d+) in (\w+)', where)
    lines = [int(line) for name, line, _ in stack if Path(name).name == file.name]
    inside = [name for _, _, name in stack if name in {"drive_callback", "log_callback"}]
    if stack and not lines:  # nothing of the learner's was at work: a machine that is too busy
        return RunFacts(RunOutcome.CANNOT, f"the simulation took longer than {seconds:g} s")
    line = lines[0] if lines else 0
    place = f"{file.name}, line {line}: " if line else ""
    said = f"{place}this did not end within {seconds:g} s"
    callback = inside[0].removesuffix("_callback") if inside else ""
    return RunFacts(RunOutcome.ENDLESS, said, line, callback)


def _facts(seen: dict[str, Any], folder: Path, file: Path) -> RunFacts:
    if "cannot" in seen:
        return RunFacts(RunOutcome.CANNOT, format_one_line(seen["cannot"]))
    if "crash" in seen:
        return _crash(seen["crash"], file)
    if "presses" in seen:
        return RunFacts(
            RunOutcome.RAN, presses=tuple(_press(one) for one in seen["presses"][:MOST_PRESSES])
        )
    columns = list(zip(*seen["rows"], strict=True))
    if not columns:
        return RunFacts(RunOutcome.CANNOT, "no test started")
    numbers = [np.array(column, dtype=np.float64) for column in columns[1:5]]
    trace = BenchTrace(np.array(columns[0], dtype=np.str_), *numbers)
    lasted = float(seen["lasted"]["quasistatic-forward"])
    slow = np.flatnonzero(trace.test == "quasistatic-forward")
    fast = np.flatnonzero(trace.test == "dynamic-forward")
    facts: dict[str, Any] = {
        "ramp": float(np.polyfit(trace.time[slow], trace.asked[slow], 1)[0]),
        "step": float(np.median(trace.asked[fast])),
        "timeout": math.inf if lasted >= LONGEST else round(lasted, 1),
        "motors": _driven(seen["motors"], trace),
        "required": bool(seen["required"]),
        "per_pulse": tuple(float(size) for size in seen["per_pulse"]),
    }
    return _with_log(folder / "robot.wpilog", trace, facts)


def _press(seen: dict[str, Any]) -> ButtonPress:
    """One press; the routine calls its tests ``kDynamicForward``."""
    tests = (
        re.sub(r"(?<=[a-z])(?=[A-Z])", "-", format_one_line(one)[1:]) for one in seen["tests"][:4]
    )
    held = bool(seen["test mode"]), int(seen["port"]), format_one_line(seen["button"])
    return ButtonPress(*held, tuple(one.lower() for one in tests), bool(seen["stayed"]))


def _crash(crash: dict[str, Any], file: Path) -> RunFacts:
    """One line of a learner's traceback; the other season's names are nobody's mistake."""
    error, line = format_one_line(crash["error"]), int(crash["line"])
    other = explain_other_season(error, file.read_text(encoding="utf-8", errors="replace"))
    if other:
        return RunFacts(RunOutcome.CANNOT, other)
    place = f"{format_one_line(crash['file'])}, line {line}: " if line else ""
    return RunFacts(RunOutcome.CRASHED, f"{place}{error}", line, format_one_line(crash["where"]))


def _driven(names: list[str], trace: BenchTrace) -> tuple[DrivenMotor, ...]:
    asked = np.abs(trace.asked)
    rows = np.flatnonzero((asked > AWAKE) & (asked < WHOLE))
    if not rows.size:
        return tuple(
            DrivenMotor(format_one_line(name), _own(name), None, 0.0, 0.0) for name in names
        )
    late = rows[: np.count_nonzero(trace.test[rows] == trace.test[rows[0]])]  # of its first test
    example = late[late.size * 4 // 5]
    driven = []
    for number, name in enumerate(names):
        share = float(np.median(trace.applied[rows, number] / trace.asked[rows]))
        at = float(trace.applied[example, number]), float(trace.asked[example])
        driven.append(DrivenMotor(format_one_line(name), _own(name), round(share, 4), *at))
    return tuple(driven)


def _own(name: str) -> bool:
    return not name.startswith("PWM ")


def _with_log(path: Path, trace: BenchTrace, facts: dict[str, Any]) -> RunFacts:
    try:
        names = _names(_left(path))
        logs = {name: read(path, motor=name) for name in names or ()}
    except FileNotFoundError:
        return RunFacts(RunOutcome.RAN, **facts, lacking="it is gone")
    except Refusal as refusal:
        return RunFacts(RunOutcome.RAN, **facts, lacking=format_one_line(refusal.what))
    if names is None:
        return RunFacts(RunOutcome.RAN, **facts)
    if not names:
        lacking = "no motor in it has voltage, position and velocity"
        return RunFacts(RunOutcome.RAN, **facts, lacking=lacking)
    tests = dict.fromkeys(run.test for log in logs.values() for run in log.runs)
    recorded = tuple(_recorded(name, log, trace) for name, log in logs.items())
    return RunFacts(RunOutcome.RAN, **facts, tests=tuple(tests), recorded=recorded)


def _names(path: Path) -> list[str] | None:
    """The motors of the log that have all three signals; None if it does not name the tests."""
    entries = read_contents(load_records(path)).entries
    state = next((one.name for one in entries if one.name.startswith(STATE)), None)
    if state is None:
        return None
    end = "-" + state.removeprefix(STATE)
    there: dict[str, set[str]] = {}
    for one in entries:
        signal, _, rest = one.name.partition("-")
        if rest.endswith(end) and signal in NEEDED:
            there.setdefault(rest.removesuffix(end), set()).add(signal)
    return [name for name, signals in there.items() if signals == NEEDED][:MOST_MOTORS]


def _recorded(name: str, log: Log, trace: BenchTrace) -> LoggedMotor:
    pairs = [(run, trace.during(run)) for run in log.runs if run.test in trace.test]
    voltage = np.concatenate([run.voltage for run, _ in pairs])
    asked = np.concatenate([seen.asked for _, seen in pairs])
    applied = np.concatenate([seen.applied for _, seen in pairs])
    motor = int(np.argmin(np.abs(applied - voltage[:, None]).sum(axis=0)))
    got = applied[:, motor]
    awake = np.abs(got) > AWAKE
    kept, lowered = _low(pairs, motor)
    encoder, scale = _followed(pairs, size=find_unit(log.units).si)
    as_asked = bool(np.ptp(voltage) > 0 and np.allclose(voltage, asked, rtol=0, atol=1e-9))
    return LoggedMotor(
        format_one_line(name),
        _share(voltage[awake], got[awake]),
        as_asked and not np.allclose(got, asked, rtol=0, atol=1e-9),
        kept,
        lowered,
        _rate(pairs),
        _forward(pairs),
        scale,
        encoder,
        find_unit(log.units).angular,
    )


def _share(part: Array, whole: Array) -> float | None:
    """How many times ``whole`` fits ``part`` best; None where there is nothing to fit."""
    square = float(whole @ whole)
    return float(part @ whole) / square if square > 0 else None


def _low(pairs: list[tuple[Run, BenchTrace]], motor: int) -> tuple[float, float]:
    """Logged and real voltage while the battery was low."""
    for run, seen in pairs:
        if run.test == "dynamic-forward":
            passed = run.time - run.time[0]
            low = (passed > LOW[0]) & (passed < LOW[1])
            if low.any():
                return float(run.voltage[low].mean()), float(seen.applied[low, motor].mean())
    return 0.0, 0.0


def _rate(pairs: list[tuple[Run, BenchTrace]]) -> float | None:
    """The logged velocities over the slopes of the logged positions, by least squares."""
    slopes, rates = [], []
    for run, _ in pairs:
        if len(run) > 2 and np.ptp(run.position) > MOVED:  # noqa: PLR2004 - a slope in the middle
            slopes.append(np.gradient(run.position, run.time)[1:-1])
            rates.append(run.velocity[1:-1])
    return _share(np.concatenate(rates), np.concatenate(slopes)) if slopes else None


def _forward(pairs: list[tuple[Run, BenchTrace]]) -> bool | None:
    volts = np.concatenate([run.voltage for run, _ in pairs])
    speeds = np.concatenate([run.velocity for run, _ in pairs])
    moving = (np.abs(volts) > AWAKE) & (np.abs(speeds) > MOVED)
    return bool((volts * speeds)[moving].sum() > 0) if moving.any() else None


def _followed(
    pairs: list[tuple[Run, BenchTrace]], *, size: float
) -> tuple[int | None, float | None]:
    """The encoder that a logged position follows, and how many times larger it is."""
    position = np.concatenate([run.position - run.position[0] for run, _ in pairs]) / size
    best: tuple[float, int, float] | None = None
    for number in range(pairs[0][1].distance.shape[1]):
        truth = np.concatenate(
            [seen.distance[:, number] - seen.distance[0, number] for _, seen in pairs]
        )
        scale = _share(position, truth)
        if not scale or np.ptp(truth) < MOVED:
            continue
        misfit = float(
            np.linalg.norm(position - scale * truth) / abs(scale) / np.linalg.norm(truth)
        )
        if misfit < FOLLOWS and (best is None or misfit < best[0]):
            best = misfit, number, scale
    return (None, None) if best is None else (best[1], round(best[2], 5))
