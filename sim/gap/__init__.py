"""Where, and by how much, simulation and data disagree.

    found = gap_map(residuals, noise=noise)
    found.places(5)                     # in words, the surest first

What a model leaves of each sample is sorted by run and time, by direction and speed, by direction
and position, by the time since the voltage jumped, and by voltage at rest. Everything is told in
noises, so a shooter and an arm read alike.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sim.errors import BadRequest
from sim.fit.seen import Noise
from sim.gap.cells import Cells, Sorted
from sim.gap.place import POSITION, REST, RUN, SPEED, STEPS, Place
from sim.gap.repeats import Repeat, repeats
from sim.gap.residuals import Residuals
from sim.log import Array

__all__ = ["Cells", "GapMap", "Place", "Repeat", "Residuals", "gap_map"]

TIMES, SPEEDS, POSITIONS, VOLTS = 12, 8, 12, 4  # columns
AFTER = (0.0, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6)  # [s] since a jump: short where things happen
STILL = 0.02  # [share of the top speed] slower is at rest
OF_A_KIND = 2  # places of one kind among the first that are told: the others say the same again
WAYS = ("forward", "reverse")
JUMPS = ("the voltage jumps up", "the voltage jumps down")
HELD = ("at rest under forward voltage", "at rest under reverse voltage")


@dataclass(frozen=True, eq=False)
class GapMap:
    """Where they disagree.

    Args:
        by_run: run × time.
        by_speed: direction × speed.
        by_position: direction × position.
        after_steps: direction of the jump × time since it.
        at_rest: direction × voltage that does not move it.
        repeats: pairs of runs of the same test; empty if none was repeated.
    """

    by_run: Cells
    by_speed: Cells
    by_position: Cells
    after_steps: Cells
    at_rest: Cells
    repeats: tuple[Repeat, ...]

    @property
    def maps(self) -> tuple[Cells, ...]:
        """All of them."""
        return (self.by_run, self.by_speed, self.by_position, self.after_steps, self.at_rest)

    def places(self, most: int, *, signal: str = "") -> tuple[Place, ...]:
        """Where it is beyond doubt that they disagree, the surest first; empty if nowhere is.

        Args:
            most: so many at most, and of one kind only two.
            signal: ``position`` or ``velocity``; empty looks at both.
        """
        kept = []
        for cells in self.maps:
            mine = [one for one in cells.places() if signal in {"", one.signal}]
            kept += sorted(mine, key=lambda one: -one.sure)[:OF_A_KIND]
        return tuple(sorted(kept, key=lambda one: -one.sure)[:most])


def gap_map(runs: Sequence[Residuals], *, noise: Noise) -> GapMap:
    """Sort what a model leaves of some runs.

    Args:
        runs: what it leaves of each.
        noise: standard deviations of a position and a velocity of which that is told in.

    Raises:
        BadRequest: there is nothing to compare.
    """
    runs = [run for run in runs if run.compared.any()]
    if not runs:
        raise BadRequest(
            "there is nothing to compare", advice="Give a run in which the mechanism moves."
        )
    missed = np.concatenate([run.missed for run in runs])
    predicted = np.concatenate([run.predicted for run in runs])
    voltage = np.concatenate([run.voltage for run in runs])
    number = np.repeat(np.arange(len(runs)), [run.time.size for run in runs])
    kept = ~np.isnan(missed).all(axis=1)
    speed = np.abs(predicted[:, 1])
    top = float(speed[kept].max())
    rests = speed <= STILL * top
    way = np.sign(np.where(rests, voltage, predicted[:, 1]))
    way[way == 0.0] = 1.0
    side = np.where(way > 0.0, 0, 1)
    moves = np.where(rests, -1, side)
    samples = Sorted(missed / np.array([noise.position, noise.velocity]), number)
    held = np.where(rests & kept, np.abs(voltage), np.nan)
    since, jump = _since(runs, largest=float(np.abs(voltage).max()), still=STILL * top)
    position = predicted[kept, 0]
    return GapMap(
        samples.into(
            RUN, _names(runs), _times(runs), row=number, way=way,
            value=np.concatenate([run.since for run in runs]),
        ),
        samples.into(
            SPEED, WAYS, _even(0.0, top, SPEEDS), row=moves, value=speed, way=way, shares=True,
        ),
        samples.into(
            POSITION, WAYS, _even(float(position.min()), float(position.max()), POSITIONS),
            row=moves, value=predicted[:, 0], way=way, shares=True,
        ),
        samples.into(
            STEPS, JUMPS, np.tile(AFTER, (2, 1)), row=np.where(jump > 0.0, 0, 1), value=since,
            way=jump,
        ),
        samples.into(
            REST, HELD, _even(0.0, float(np.max(held, initial=0.0, where=~np.isnan(held))), VOLTS),
            row=np.where(rests, side, -1), value=held, way=way,
        ),
        repeats(runs, noise=noise.velocity),
    )  # fmt: skip


def _names(runs: Sequence[Residuals]) -> tuple[str, ...]:
    """Of each run its test, counted where there are several."""
    tests = [run.test for run in runs]
    return tuple(
        f"{test} ({tests[: i + 1].count(test)})" if tests.count(test) > 1 else test
        for i, test in enumerate(tests)
    )


def _times(runs: Sequence[Residuals]) -> Array:
    """(runs, columns + 1) [s] equal stretches of what is compared of each run."""
    ends = [run.since[run.compared][[0, -1]] for run in runs]
    return np.stack([np.linspace(start, end, TIMES + 1) for start, end in ends])


def _even(low: float, high: float, columns: int) -> Array:
    """(2, columns + 1) equal columns for either direction."""
    return np.tile(np.linspace(low, max(high, low + 1e-12), columns + 1), (2, 1))


def _since(runs: Sequence[Residuals], *, largest: float, still: float) -> tuple[Array, Array]:
    """(n,) [s] since the voltage jumped, and which way it did."""
    found = [run.steps(largest=largest, still=still) for run in runs]
    return np.concatenate([one for one, _ in found]), np.concatenate([one for _, one in found])
