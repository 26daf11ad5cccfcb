"""Nuisance parameters of each run: start position, backlash phase, friction and lag."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from sim.core.log import Array


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
        """No offsets: each run starts where its first sample says."""
        return cls(np.zeros(runs), np.full(runs, np.nan), np.zeros(runs), np.zeros(runs))

    def select_runs(self, chosen: Sequence[int]) -> "RunNuisance":
        """The nuisance parameters of some runs."""
        places = list(chosen)
        return RunNuisance(
            self.position_offset[places],
            self.backlash_phase[places],
            self.friction_offset[places],
            self.lag_offset[places],
        )

    def shift_positions(self, by: Array) -> "RunNuisance":
        """The same, with positions shifted by ``by`` (runs,) [unit]."""
        return replace(self, position_offset=self.position_offset + by)

    def add_friction(self, by: Array) -> "RunNuisance":
        """The same, with ``by`` (runs,) [V] more friction in each run."""
        return replace(self, friction_offset=self.friction_offset + by)

    def add_lag(self, by: Array) -> "RunNuisance":
        """The same, with each run ``by`` (runs,) [s] later."""
        return replace(self, lag_offset=self.lag_offset + by)

    @property
    def with_common_friction(self) -> "RunNuisance":
        """The same, with one friction for all runs."""
        return replace(self, friction_offset=np.zeros_like(self.friction_offset))

    def with_backlash_phase(self, phase: Array) -> "RunNuisance":
        """The same, with these backlash phases (runs,)."""
        return replace(self, backlash_phase=phase)

    @property
    def without_backlash_phase(self) -> "RunNuisance":
        """The same, where the load's weight decides on the backlash phase."""
        return self.with_backlash_phase(np.full_like(self.backlash_phase, np.nan))

    @property
    def has_backlash_phase(self) -> bool:
        """Whether the backlash phase of any run is given."""
        return not bool(np.isnan(self.backlash_phase).all())
