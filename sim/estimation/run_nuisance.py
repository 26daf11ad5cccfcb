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
    def seen(cls, runs: int) -> "RunNuisance":
        """Just as the first samples say."""
        return cls(np.zeros(runs), np.full(runs, np.nan), np.zeros(runs))

    def of(self, chosen: Sequence[int]) -> "RunNuisance":
        """That of some runs."""
        places = list(chosen)
        return RunNuisance(
            self.position_offset[places], self.backlash_phase[places], self.friction_offset[places]
        )

    def moved(self, by: Array) -> "RunNuisance":
        """The same; ``by`` (runs,) [unit] further."""
        return replace(self, position_offset=self.position_offset + by)

    def rubbing(self, by: Array) -> "RunNuisance":
        """The same; each run with ``by`` (runs,) [V] more friction."""
        return replace(self, friction_offset=self.friction_offset + by)

    @property
    def alike(self) -> "RunNuisance":
        """The same, all runs with one friction."""
        return replace(self, friction_offset=np.zeros_like(self.friction_offset))

    def meshing(self, meshed: Array) -> "RunNuisance":
        """The same, with ``meshed`` (runs,)."""
        return replace(self, backlash_phase=meshed)

    @property
    def unmeshed(self) -> "RunNuisance":
        """The same; where in free play a run begins is left to the load's weight."""
        return self.meshing(np.full_like(self.backlash_phase, np.nan))

    @property
    def is_meshed(self) -> bool:
        """Whether it is told of any run where in free play that begins."""
        return not bool(np.isnan(self.backlash_phase).all())
