"""Logs of real robots: fits, repetitions, predictions of unseen runs, and what reconcile explains.

    python tests/benchmarks/bench_real.py [FOLDER] [--reconcile] [--only WORD]

FOLDER is searched for logs; without it, the folder of ``SYSID_SHARED`` is. Nobody knows the true
gains of these robots, so each table asks something that needs no truth:

* every log is fitted or refused: in how much processor time, and with which warnings;
* recordings of one mechanism on one day should agree within their stated errors;
* three runs are fitted and predict the fourth, open loop, by our method and by SysId's recipe;
* with ``--reconcile``, inspected first as the command does: what is named, and how much of the base
  model's simulation error is left.

SysId itself refuses three tests. Its recipe is therefore prepared with all four, which tells it
what to trim, and regressed on the rows of three.
"""

import argparse
import math
import os
import re
import time
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path

import numpy as np

import sim
from sim.cli.log_reader import LogReader
from sim.cli.open.reconcile_job import inspect_damage
from sim.core.errors import Refusal
from sim.core.log import Log, Run
from sim.core.units import find_unit
from sim.fit import fit
from sim.fit.between_recordings import SHARES
from sim.fit.regression import regress_acceleration
from sim.fit.result import Fit
from sim.fit.sysid_rows import prepare_rows
from sim.physics.model import Model, Part
from sim.physics.replay import replay_log
from sim.reconcile import reconcile
from sim.reconcile.story import Story

SUFFIXES = (".csv", ".json", ".wpilog")
GAINS = ("kS", "kV", "kA", "kG")
DAY = re.compile(r"20\d\d[-_]?\d\d[-_]?\d\d")
REBUILT = 1.25  # [1] volts per speed over those of another recording: another mechanism
MEDIAN = 0.6745  # [standard deviations] median size of a normal deviation
WITHIN = 2.0  # [1] standard errors of a difference, within which two recordings agree
LOGS = {
    "sciborgs-2023-elbow-arm": "arm",
    "sciborgs-2023-wrist-arm": "arm",
    "sciborgs-2023-elevator": "elevator",
    "frc4646-2022-drivetrain": "simple",
    "frc501-2020-drivetrain": "simple",
}
"""Name of a file -> type of its mechanism."""


@dataclass(frozen=True)
class HeldOutScore:
    """What both methods make of a run they have not seen.

    Args:
        log: name of the file.
        test: the run that was left out.
        unit: of the velocity.
        recipe: [unit/s] root mean square error of SysId's recipe; nan where it has no answer.
        ours: the same, of method output-error.
    """

    log: str
    test: str
    unit: str
    recipe: float
    ours: float


def folder() -> Path:
    """Where logs of real robots are kept, if anywhere."""
    beside = Path(__file__).resolve().parents[3] / "shared"
    return Path(os.environ.get("SYSID_SHARED", beside)) / "data" / "real"


def held_out(where: Path) -> Iterator[HeldOutScore]:
    """Every run of every log in a folder; nothing where there are none."""
    for name, type_ in LOGS.items():
        path = where / f"{name}.json"
        if path.is_file():
            yield from leave_out_each(sim.read(path), name, type_)


def leave_out_each(log: Log, name: str, type_: str) -> Iterator[HeldOutScore]:
    """Every run of a log, predicted from the others."""
    unit = "rad" if type_ == "arm" else "m"
    for run in log.runs:
        errors = [miss(way(log, run, type_), log, run) for way in (by_recipe, by_ours)]
        yield HeldOutScore(name, run.test, unit, *errors)


def by_recipe(log: Log, run: Run, type_: str) -> Model | None:
    """SysId's recipe without the rows of one run."""
    try:
        rows = prepare_rows(log).rows
        kept = {t: part.select(slice(0, 0)) if t == run.test else part for t, part in rows.items()}
        return Model(type_, regress_acceleration(kept, type=type_).gains)
    except Refusal:
        return None


def by_ours(log: Log, run: Run, type_: str) -> Model | None:
    """Method output-error without one run."""
    rest = replace(log, runs=tuple(one for one in log.runs if one is not run))
    try:
        found = fit(rest, type=type_)
    except Refusal:
        return None
    parts = []
    if found.velocity_delay > found.position_delay:
        window = 2.0 * (found.velocity_delay - found.position_delay)  # an average is half as late
        parts.append(Part("velocity-filter", {"window": window}))
    if found.position_delay > 0.0:
        parts.append(Part("delay", {"lag": found.position_delay}))
    return Model(type_, found.gains, (*parts, *found.parts))


def miss(model: Model | None, log: Log, run: Run) -> float:
    """[unit/s] root mean square of measured velocity less predicted; nan without a model."""
    if model is None:
        return math.nan
    (track,) = replay_log(model, replace(log, runs=(run,)))
    return float(np.sqrt(np.mean(np.square(track.seen - run.velocity))))


@dataclass(frozen=True, eq=False)
class FittedLog:
    """A log, and what the fit makes of it.

    Args:
        path: of the file.
        log: what was read; None if it was refused.
        fit: None if it was refused.
        refusal: why, in a line; empty if it was not.
        seconds: of processor time, to read and to fit.
    """

    path: Path
    log: Log | None
    fit: Fit | None
    refusal: str
    seconds: float

    @property
    def recording(self) -> tuple[str, ...]:
        """What recordings of one mechanism on one day have in common: place, day, type, unit."""
        day = DAY.search(self.path.stem)
        family = DAY.split(self.path.stem)[0] if day else self.path.stem
        kind = (self.fit.type, self.fit.units) if self.fit else ()
        angular = "angular" if "angular" in self.path.stem else ""
        return (str(self.path.parent), family, day[0] if day else "", angular, *kind)


def list_logs(where: Path, only: str) -> list[Path]:
    """The logs of a folder and those below it, whose names contain a word."""
    found = [one for one in where.rglob("*") if one.suffix.lower() in SUFFIXES]
    return sorted(one for one in found if only in one.name)


def fit_log(path: Path) -> FittedLog:
    """Read and fit a log as ``sysid fit FILE`` does."""
    started = time.process_time()
    log, found, refusal = None, None, ""
    try:
        log = LogReader().read_joined([path])
        found = fit(log, type=log.type or "simple").in_units(log.units)
    except Refusal as refused:
        refusal = str(refused).splitlines()[0]
    return FittedLog(path, log, found, refusal, time.process_time() - started)


def print_fits(fitted: Sequence[FittedLog]) -> None:
    """One line for each log."""
    print("\nFITS")
    for one in fitted:
        name = one.path.name[-60:]
        if one.fit is None:
            print(f"{name:60} {one.seconds:6.2f} s  refused: {one.refusal}")
            continue
        gains = [
            f"{gain} {one.fit.gains[gain]:.4g} ± {one.fit.errors[gain]:.2g}"
            for gain in GAINS
            if one.fit.gains.get(gain)
        ]
        codes = ", ".join(sorted({doubt.code for doubt in one.fit.doubts}))
        print(f"{name:60} {one.seconds:6.2f} s  {'  '.join(gains)}  [{codes}]")
    done = [one.fit for one in fitted if one.fit is not None]
    strays = sum(any(doubt.code == "model-strays" for doubt in one.doubts) for one in done)
    seconds = [one.seconds for one in fitted]
    print(
        f"{len(done)} of {len(fitted)} fitted, {strays} with model-strays; "
        f"median {np.median(seconds):.2f} s, most {max(seconds):.2f} s"
    )


def volts_at_top_speed(log: Log) -> float:
    """[V per unit/s] voltage over velocity, median of the fastest hundredth of a log's samples."""
    speed = np.abs(np.concatenate([run.velocity for run in log.runs]))
    volts = np.abs(np.concatenate([run.voltage for run in log.runs]))
    fastest = speed >= np.nanquantile(speed, 0.99)
    return float(np.nanmedian(volts[fastest] / speed[fastest]))


def print_repetitions(fitted: Sequence[FittedLog]) -> None:
    """How many pairs of gains from recordings of one mechanism agree within their errors.

    The error of a pair holds that of both fits and what recordings of one day differ by.

    Where the fastest samples of two recordings need volts per speed that differ by more than
    ``REBUILT``, the gears or the conversion factor changed between them: such a pair is listed, and
    does not count.
    """
    print("\nREPETITIONS")
    groups: dict[tuple[str, ...], list[tuple[str, Fit, float]]] = defaultdict(list)
    for log in fitted:
        if log.fit is not None and log.log is not None and log.recording[2]:
            price = volts_at_top_speed(log.log)
            groups[log.recording].append((log.path.stem[-50:], log.fit, price))
    agree = count = 0
    differences: dict[str, list[float]] = defaultdict(list)
    for group in groups.values():
        for (name, one, price), (_, other, other_price) in combinations(group, 2):
            if max(price, other_price) > REBUILT * min(price, other_price):
                print(f"{name} changed between two recordings: {price:.4g} and "
                      f"{other_price:.4g} V per unit/s; not counted")  # fmt: skip
                continue
            for gain in GAINS:
                both = one.gains.get(gain), other.gains.get(gain)
                if not all(both):
                    continue
                between = SHARES[gain] / MEDIAN * 0.5 * abs(sum(both))
                error = math.hypot(one.errors[gain], other.errors[gain], between)
                apart = abs(one.gains[gain] - other.gains[gain])
                count += 1
                agree += apart <= WITHIN * error
                if apart > WITHIN * error:
                    print(f"{name} {gain} {both[0]:.4g}, {both[1]:.4g}: {apart / error:.1f} errors")
                differences[gain].append(apart / abs(one.gains[gain] + other.gains[gain]) * 2)
    if not count:
        print("no two recordings of one mechanism on one day")
        return
    typical = ", ".join(
        f"{gain} {100 * np.median(all_):.1f} %" for gain, all_ in differences.items()
    )
    print(f"{agree} of {count} pairs of gains agree within {WITHIN:g} errors ({agree / count:.0%})")
    print(f"median difference: {typical}")


def print_held_out(fitted: Sequence[FittedLog]) -> None:
    """By how much each method misses a run that it has not seen."""
    print("\nRUNS LEFT OUT")
    runs = [
        run
        for one in fitted
        if one.log is not None and one.fit is not None
        for run in leave_out_each(one.log, one.path.stem, one.fit.type)
    ]
    both = [run for run in runs if math.isfinite(run.recipe) and math.isfinite(run.ours)]
    if not both:
        print("no log has enough runs")
        return
    ratios = [run.ours / run.recipe for run in both]
    worse = [run for run in both if run.ours > run.recipe]
    for run in worse:
        print(
            f"{run.log[-60:]:60} {run.test:20} {run.ours / run.recipe:6.3f} of the recipe's error"
        )
    print(
        f"{len(both) - len(worse)} of {len(both)} no worse than the recipe; "
        f"median {np.median(ratios):.2f} of its error"
    )


def print_reconciled(fitted: Sequence[FittedLog], *, effort: float) -> None:
    """What reconcile makes of each log that can be fitted."""
    print("\nRECONCILE")
    verdicts: Counter[str] = Counter()
    seconds = []
    for one in fitted:
        if one.log is None or one.fit is None:
            continue
        started = time.process_time()
        name = one.path.name[-60:]
        try:
            damages = {"log": inspect_damage(one.log)}
            story = reconcile(one.log, type=one.fit.type, damages=damages, effort=effort)
        except Refusal as refused:
            print(f"{name:60} refused: {str(refused).splitlines()[0]}", flush=True)
            continue
        seconds.append(time.process_time() - started)
        verdicts[story.verdict] += 1
        print(f"{name:60} {seconds[-1]:5.1f} s  {describe_story(story, one.log)}", flush=True)
    if seconds:
        print(", ".join(f"{count} {verdict}" for verdict, count in sorted(verdicts.items())))
        print(f"processor time: median {np.median(seconds):.1f} s, most {max(seconds):.1f} s")


def describe_story(story: Story, log: Log) -> str:
    """Verdict, what is left of the gap, and the named effects, in a line."""
    named = ", ".join(
        f"{found.effect} ({found.size}, {found.gap_before:.3g} -> {found.gap_after:.3g})"
        for found in story.findings
    )
    top = max(run.top_speed for run in log.runs) / find_unit(log.units).si
    return (
        f"{story.verdict}{' + remainder' if story.remainder else ''}"
        f"  left {story.gap_after / story.noise_floor:.3g} floors, {story.gap_after / top:.1%} of"
        f" top speed; {named or 'no effect'}"
    )


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, nargs="?", default=folder())
    parser.add_argument("--reconcile", action="store_true", help="reconcile each log as well")
    parser.add_argument("--only", default="", help="only files whose name contains this")
    parser.add_argument("--effort", type=float, default=1.0, help="of reconcile")
    given = parser.parse_args()
    paths = list_logs(given.folder, given.only)
    if not paths:
        print(
            f"no logs of real robots in {given.folder} (set SYSID_SHARED to the folder above data)"
        )
        return
    fit_log(paths[0])  # compiles the engine, so that no log's time holds it
    fitted = [fit_log(path) for path in paths]
    print_fits(fitted)
    print_repetitions(fitted)
    print_held_out(fitted)
    if given.reconcile:
        print_reconciled(fitted, effort=given.effort)


if __name__ == "__main__":
    main()
