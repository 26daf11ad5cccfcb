"""The gap between simulation and measurement, by run, speed, position and time.

    found = map_gap(residuals, noise=noise)
    found.find_places(5)                # the bins with the most significant residuals

The residual of each sample is binned by run and time, by direction and speed, by direction and
position, by the time since a voltage step, and by voltage at rest. All numbers are multiples of the
noise, so mechanisms of any kind can be compared.
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

PER_MAP = 2  # places of one map that are listed; the others are mostly the same


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
            most: number of places, at most; of each map there are only two.
            signal: ``position`` or ``velocity``; empty for both.
        """
        kept = []
        for residuals in self.all_maps:
            mine = [one for one in residuals.find_places() if signal in {"", one.signal}]
            kept += sorted(mine, key=lambda one: -one.sure)[:PER_MAP]
        return tuple(sorted(kept, key=lambda one: -one.sure)[:most])


def map_gap(runs: Sequence[Residuals], *, noise: SensorNoise) -> GapMap:
    """Bin residuals by run, speed, position, time after a step, and voltage at rest.

    Args:
        runs: residuals of each run.
        noise: standard deviations of a position and a velocity, the unit of the residuals.

    Raises:
        BadRequest: no sample is compared.
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
