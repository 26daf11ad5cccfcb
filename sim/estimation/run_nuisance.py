"""Nuisance parameters of each run: start position, backlash phase and additional friction."""

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
    """

    position_offset: Array
    backlash_phase: Array
    friction_offset: Array

    @classmethod
    def at_first_samples(cls, runs: int) -> "RunNuisance":
        """Just as the first samples say."""
        return cls(np.zeros(runs), np.full(runs, np.nan), np.zeros(runs))

    def select_runs(self, chosen: Sequence[int]) -> "RunNuisance":
        """That of some runs."""
        places = list(chosen)
        return RunNuisance(
            self.position_offset[places], self.backlash_phase[places], self.friction_offset[places]
        )

    def shift_positions(self, by: Array) -> "RunNuisance":
        """The same; ``by`` (runs,) [unit] further."""
        return replace(self, position_offset=self.position_offset + by)

    def add_friction(self, by: Array) -> "RunNuisance":
        """The same; each run with ``by`` (runs,) [V] more friction."""
        return replace(self, friction_offset=self.friction_offset + by)

    @property
    def with_common_friction(self) -> "RunNuisance":
        """The same, all runs with one friction."""
        return replace(self, friction_offset=np.zeros_like(self.friction_offset))

    def with_backlash_phase(self, meshed: Array) -> "RunNuisance":
        """The same, with ``meshed`` (runs,)."""
        return replace(self, backlash_phase=meshed)

    @property
    def without_backlash_phase(self) -> "RunNuisance":
        """The same; where in free play a run begins is left to the load's weight."""
        return self.with_backlash_phase(np.full_like(self.backlash_phase, np.nan))

    @property
    def has_backlash_phase(self) -> bool:
        """Whether it is told of any run where in free play that begins."""
        return not bool(np.isnan(self.backlash_phase).all())
