"""The gap between simulation and measurement, by run, speed, position and time.

    found = gap_map(residuals, noise=noise)
    found.places(5)                     # in words, the surest first

The residual of each sample is binned by run and time, by direction and speed, by direction and
position, by the time since a voltage step, and by voltage at rest. All numbers are multiples of the
noise, so that a shooter and an arm can be compared.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from sim.core.errors import BadRequest
from sim.estimation.measurements import SensorNoise
from sim.gap.binned_residuals import BinnedResiduals
from sim.gap.bins import ResidualBins
from sim.gap.place import Place
from sim.gap.repeats import Repeat, compare_repeats
from sim.gap.residuals import Residuals

__all__ = ["BinnedResiduals", "GapMap", "Place", "Repeat", "Residuals", "map_gap"]

OF_A_KIND = 2  # places of one kind among the first that are told: the others say the same again


@dataclass(frozen=True, eq=False)
class GapMap:
    """Residuals binned in several ways: where simulation and measurement disagree.

    Args:
        by_run: run × time.
        by_speed: direction × speed.
        by_position: direction × position.
        after_steps: direction of the voltage step × time since it.
        at_rest: direction × voltage while it does not move.
        repeats: pairs of runs of the same test; empty if none was repeated.
    """

    by_run: BinnedResiduals
    by_speed: BinnedResiduals
    by_position: BinnedResiduals
    after_steps: BinnedResiduals
    at_rest: BinnedResiduals
    repeats: tuple[Repeat, ...]

    @property
    def all_maps(self) -> tuple[BinnedResiduals, ...]:
        """The binned residuals, one map for each way of binning."""
        return (self.by_run, self.by_speed, self.by_position, self.after_steps, self.at_rest)

    def find_places(self, most: int, *, signal: str = "") -> tuple[Place, ...]:
        """The bins with significant residuals, the most significant first.

        Args:
            most: so many at most, and of one kind only two.
            signal: ``position`` or ``velocity``; empty looks at both.
        """
        kept = []
        for cells in self.all_maps:
            mine = [one for one in cells.find_places() if signal in {"", one.signal}]
            kept += sorted(mine, key=lambda one: -one.sure)[:OF_A_KIND]
        return tuple(sorted(kept, key=lambda one: -one.sure)[:most])


def map_gap(runs: Sequence[Residuals], *, noise: SensorNoise) -> GapMap:
    """Bin residuals by run, speed, position, time after a step, and voltage at rest.

    Args:
        runs: what it leaves of each.
        noise: standard deviations of a position and a velocity, in whose multiples gaps are given.

    Raises:
        BadRequest: there is nothing to compare.
    """
    runs = [run for run in runs if run.compared.any()]
    if not runs:
        raise BadRequest(
            "there is nothing to compare", advice="Give a run in which the mechanism moves."
        )
    samples = ResidualBins(runs, noise=noise)
    return GapMap(
        samples.bin_by_run(),
        samples.bin_by_speed(),
        samples.bin_by_position(),
        samples.bin_after_steps(),
        samples.bin_at_rest(),
        compare_repeats(runs, noise=noise.velocity),
    )
