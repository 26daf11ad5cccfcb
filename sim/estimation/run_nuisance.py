"""Nuisance parameters of each run: start position, backlash phase, friction and lag."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from sim.core.log import Array

POSITION, FRICTION, LAG = "position_offset", "friction_offset", "lag_offset"
"""Names of the offsets that differ at random from run to run."""

ON_ONE_SIDE = 2.0 * math.log(3.0)
"""[of -2 log L] Prior cost of a backlash phase at one of the two ends of the backlash."""

BETWEEN = ON_ONE_SIDE + 2.0 * math.log(10.0)
"""[of -2 log L] Prior cost of a phase between the ends, where only friction holds the motor.

A motor that starts at one end of its backlash, and one that starts in the middle of twice as much
backlash, reach the load at the same moment. The prior makes the first ten times as likely.
"""


@dataclass(frozen=True, eq=False)
class RunNuisance:
    """Nuisance parameters of each run.

    Args:
        position_offset: (runs,) [unit] true position at a run's first sample, minus the first
            measurement.
        backlash_phase: (runs,) [1] where in its backlash the motor starts, from -1 to 1; nan where
            the load's weight decides.
        friction_offset: (runs,) [V] Coulomb friction of a run minus that of all runs.
        lag_offset: (runs,) [s] lag of a run's readings minus that of all runs.
    """

    position_offset: Array
    backlash_phase: Array
    friction_offset: Array
    lag_offset: Array

    @classmethod
    def at_first_samples(cls, runs: int) -> "RunNuisance":
        """Nuisance parameters without offsets: each run starts at its first measurement."""
        return cls(np.zeros(runs), np.full(runs, np.nan), np.zeros(runs), np.zeros(runs))

    def select_runs(self, chosen: Sequence[int]) -> "RunNuisance":
        """A copy with some of the runs."""
        places = list(chosen)
        return RunNuisance(*(getattr(self, one.name)[places] for one in fields(self)))

    def add(self, name: str, by: Array | float) -> "RunNuisance":
        """A copy with ``by``, for all runs or (runs,), added to one of the offsets."""
        return replace(self, **{name: getattr(self, name) + by})

    @property
    def with_common_friction(self) -> "RunNuisance":
        """A copy with one friction for all runs."""
        return replace(self, friction_offset=np.zeros_like(self.friction_offset))

    @property
    def without_backlash_phase(self) -> "RunNuisance":
        """A copy in which the load's weight decides where in its backlash a run starts."""
        return replace(self, backlash_phase=np.full_like(self.backlash_phase, np.nan))

    @property
    def backlash_phase_costs(self) -> Array:
        """(runs,) prior cost of each backlash phase, as -2 log L; 0 where it is not given."""
        given = np.where(np.abs(self.backlash_phase) == 1.0, ON_ONE_SIDE, BETWEEN)
        return np.where(np.isnan(self.backlash_phase), 0.0, given)

    @property
    def has_backlash_phase(self) -> bool:
        """Whether the backlash phase of any run is given."""
        return not bool(np.isnan(self.backlash_phase).all())
