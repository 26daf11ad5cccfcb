"""Logs of real robots: fits, repetitions, predictions of unseen runs, and what reconcile explains.

    python tests/benchmarks/bench_real.py [FOLDER] [--reconcile] [--only WORD]

FOLDER is searched for logs; without it, the folder of ``SYSID_SHARED`` is. Nobody knows the true
gains of these robots, so each table asks something that needs no truth:

* every log is fitted or refused: in how much processor time, and with which warnings;
* recordings of one mechanism on one day should agree within their stated errors;
* three runs are fitted and predict the fourth, open loop, by our method and by SysId's recipe;
* with ``--reconcile``, inspected first as the command does: how much of the base model's simulation
  error do the named effects explain,
  compared with a black box that knows no physics (gradient boosting over the simulated motion and
  past voltages, each run predicted by the others; needs scikit-learn), and does a second recording
  of the same mechanism confirm it?

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
from importlib.util import find_spec
from itertools import combinations
from pathlib import Path

import numpy as np

import sim
from sim.cli.options import LogReader
from sim.cli.reconcile import inspect_damage
from sim.core.errors import Refusal
from sim.core.log import Array, Log, Run
from sim.core.units import find_unit
from sim.fit import fit
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
WITHIN = 2.0  # [1] standard errors of a difference, within which two recordings agree
PAST = (1, 2, 3, 5, 8, 13)  # [samples] how far back the black box sees voltage and simulation
FOUND = 0.9  # [1] of the base model's error, below which the black box found something
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
                error = math.hypot(one.errors[gain], other.errors[gain])
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
    done = []
    later: dict[tuple[str, ...], FittedLog] = {}
    for one in reversed(fitted):
        if one.log is None or one.fit is None:
            continue
        other = later.get(one.recording) if one.recording[2] else None
        later[one.recording] = one
        line = reconcile_log(one, other, effort=effort)
        if line is not None:
            done.append(line)
    if not done:
        return
    verdicts = Counter(one.verdict for one in done)
    confirmed = [one.held_out for one in done if math.isfinite(one.held_out)]
    shares = [one.share for one in done if math.isfinite(one.share)]
    print(", ".join(f"{count} {verdict}" for verdict, count in sorted(verdicts.items())))
    print(f"processor time: median {np.median([one.seconds for one in done]):.1f} s, "
          f"most {max(one.seconds for one in done):.1f} s")  # fmt: skip
    if confirmed:
        print(
            f"second recordings: error below the base model's in "
            f"{sum(value < 1.0 for value in confirmed)} of {len(confirmed)}, "
            f"at most {max(confirmed):.2f} of it"
        )
    if shares:
        print(f"explained share: median {np.median(shares):.2f} of {len(shares)} logs")


@dataclass(frozen=True)
class Reconciled:
    """What reconcile made of a log.

    Args:
        verdict: its word.
        seconds: of processor time.
        held_out: [1] error on a second recording, last model over base; nan without one.
        share: [1] of the variance that the black box explains; nan where it explains too little.
    """

    verdict: str
    seconds: float
    held_out: float
    share: float


def reconcile_log(one: FittedLog, other: FittedLog | None, *, effort: float) -> Reconciled | None:
    """Reconcile a log, print a line about it, and show it on a second recording if there is one."""
    assert one.log is not None
    assert one.fit is not None
    name = one.path.name[-60:]
    started = time.process_time()
    try:
        story = reconcile(
            one.log, type=one.fit.type, damages={"log": inspect_damage(one.log)}, effort=effort
        )
    except Refusal as refused:
        print(f"{name:60} refused: {str(refused).splitlines()[0]}", flush=True)
        return None
    seconds = time.process_time() - started
    share = find_explained_share(story)
    held_out = math.nan
    if other is not None:
        held_out = compare_second_recording(one, other, effort=effort)
    named = ", ".join(
        f"{found.effect} ({found.size}, {found.gap_before:.3g} -> {found.gap_after:.3g})"
        for found in story.findings
    )
    top = max(run.top_speed for run in one.log.runs) / find_unit(one.log.units).si
    print(
        f"{name:60} {seconds:5.1f} s  {story.verdict}{' + remainder' if story.remainder else ''}"
        f"  left {story.gap_after / story.noise_floor:.3g} floors, {story.gap_after / top:.1%} of"
        f" top speed; share {share:.2f}; second recording {held_out:.2f}  {named or 'no effect'}",
        flush=True,
    )
    return Reconciled(story.verdict, seconds, held_out, share)


def compare_second_recording(one: FittedLog, other: FittedLog, *, effort: float) -> float:
    """[1] Ratio of two errors on a second recording: the last model's over the base model's.

    The recording decides nothing; it is compared where an inspection finds no damage in it. The
    result is nan where no effect was added, or where the mechanism was changed in between.
    """
    assert one.fit is not None
    assert one.log is not None
    assert other.log is not None
    damages = {"log": inspect_damage(one.log), "held_out": inspect_damage(other.log)}
    try:
        story = reconcile(
            one.log, held_out=other.log, type=one.fit.type, damages=damages, effort=effort
        )
    except Refusal:
        return math.nan
    return story.gap_after / story.gap_before if len(story.chapters) > 1 else math.nan


def find_explained_share(story: Story) -> float:
    """Of the squared error that a black box explains, the share that the named effects do [1].

    The black box predicts the base model's velocity error of each run after it was trained on the
    other runs. It sees what a simulation has: voltages and simulated motion, now and in the past.
    """
    if find_spec("sklearn") is None:
        return math.nan
    runs = story.shown.runs
    if len(runs) == 1:
        return math.nan
    base, ours = (
        [track[:, 1] - run.velocity for track, run in zip(chapter.tracks, runs, strict=True)]
        for chapter in (story.chapters[0], story.chapters[-1])
    )
    features = [
        features_of(run, track) for run, track in zip(runs, story.chapters[0].tracks, strict=True)
    ]
    box = min(boosted_error(features, base, mirrored=both) for both in (False, True))
    before, after = (float(np.mean(np.square(np.concatenate(error)))) for error in (base, ours))
    return (before - after) / (before - box) if box < FOUND**2 * before else math.nan


def boosted_error(features: Sequence[Array], errors: Sequence[Array], *, mirrored: bool) -> float:
    """Mean square of what is left of the errors of runs, each predicted from the others.

    Args:
        features: a run -> (n, k).
        errors: a run -> (n,).
        mirrored: whether a run the other way round is learned from as well: most mechanisms do the
            same in both directions, and a run forward says little about one in reverse otherwise.
    """
    from sklearn.ensemble import (  # type: ignore[import-untyped]  # noqa: PLC0415 - optional
        HistGradientBoostingRegressor,
    )

    left = []
    for out in range(len(errors)):
        seen = np.concatenate([one for at, one in enumerate(features) if at != out])
        wanted = np.concatenate([one for at, one in enumerate(errors) if at != out])
        if mirrored:
            seen, wanted = np.concatenate((seen, -seen)), np.concatenate((wanted, -wanted))
        model = HistGradientBoostingRegressor(max_iter=200, min_samples_leaf=40, random_state=0)
        left.append(errors[out] - model.fit(seen, wanted).predict(features[out]))
    return float(np.mean(np.square(np.concatenate(left))))


def features_of(run: Run, track: Array) -> Array:
    """(n, k) voltage, simulated position, velocity and acceleration, with past values."""
    acceleration = np.gradient(track[:, 1], run.time)
    now = np.column_stack((run.voltage, track, acceleration))
    past = []
    for steps in PAST:
        at = np.maximum(np.arange(len(run)) - steps, 0)
        past.append(np.column_stack((run.voltage[at], track[at, 1])))
    return np.column_stack((now, *past))


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
