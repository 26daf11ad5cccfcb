"""Fit three runs of a real log, predict the fourth: by how much each method misses its velocity.

    python tests/benchmarks/bench_held_out.py [FOLDER]

The logs are not part of the project; without them nothing is printed but where they were looked
for. A prediction moves the fitted model along the voltages of the run that was left out, open loop,
friction that holds included, for both methods alike; ours with the lag and the small effects that
it found.

SysId itself refuses three tests. Its recipe is therefore prepared with all four, which tells it
what to trim, and regressed on the rows of three.
"""

import math
import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

import sim
from sim.core.errors import Refusal
from sim.core.log import Log, Run
from sim.fit import fit
from sim.fit.regression import regress_acceleration
from sim.fit.sysid_rows import prepare_rows
from sim.physics.model import Model, Part
from sim.physics.replay import replay_log

LOGS = {
    "sciborgs-2023-elbow-arm": "arm",
    "sciborgs-2023-wrist-arm": "arm",
    "sciborgs-2023-elevator": "elevator",
    "frc4646-2022-drivetrain": "simple",
    "frc501-2020-drivetrain": "simple",
}
"""Name of a file -> type of its mechanism."""


@dataclass(frozen=True)
class HeldOut:
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


def held_out(where: Path) -> Iterator[HeldOut]:
    """Every run of every log in a folder; nothing where there are none."""
    for name, type_ in LOGS.items():
        path = where / f"{name}.json"
        if path.is_file():
            log = sim.read(path)
            unit = "rad" if type_ == "arm" else "m"
            for run in log.runs:
                errors = [miss(way(log, run, type_), log, run) for way in (by_recipe, by_ours)]
                yield HeldOut(name, run.test, unit, *errors)


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


def main() -> None:
    """Print one line for each run."""
    where = Path(sys.argv[1]) if len(sys.argv) > 1 else folder()
    worse, count = [], 0
    print(f"{'RMSE of velocity':46} {'recipe':>9} {'ours':>9} {'ours/recipe':>13}")
    for one in held_out(where):
        count += 1
        aside = "" if one.ours <= one.recipe or math.isnan(one.recipe) else "   worse"
        worse += [one] if aside else []
        print(
            f"{one.log:26} {one.test:19} {one.recipe:9.4f} {one.ours:9.4f} "
            f"{one.ours / one.recipe:13.2f} {one.unit}/s{aside}",
            flush=True,
        )
    if count:
        print(f"{count - len(worse)} of {count} no worse than the recipe")
    else:
        print(f"no logs of real robots in {where} (set SYSID_SHARED to the folder above data)")


if __name__ == "__main__":
    main()
