"""What is each run's own: how it begins, and how much more or less it rubs."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from sim.log import Array


@dataclass(frozen=True, eq=False)
class RunNuisance:
    """What is each run's own.

    Args:
        beside: (runs,) [unit] true position at its first sample, less the one seen there.
        meshed: (runs,) [1] where in its free play the motor is, from -1 to 1; nan where the load's
            weight decides.
        rubs: (runs,) [V] its dry friction, beyond that of all runs.
    """

    beside: Array
    meshed: Array
    rubs: Array

    @classmethod
    def seen(cls, runs: int) -> "RunNuisance":
        """Just as the first samples say."""
        return cls(np.zeros(runs), np.full(runs, np.nan), np.zeros(runs))

    def of(self, chosen: Sequence[int]) -> "RunNuisance":
        """That of some runs."""
        places = list(chosen)
        return RunNuisance(self.beside[places], self.meshed[places], self.rubs[places])

    def moved(self, by: Array) -> "RunNuisance":
        """The same; ``by`` (runs,) [unit] further."""
        return replace(self, beside=self.beside + by)

    def rubbing(self, by: Array) -> "RunNuisance":
        """The same; each run with ``by`` (runs,) [V] more friction."""
        return replace(self, rubs=self.rubs + by)

    @property
    def alike(self) -> "RunNuisance":
        """The same, all runs with one friction."""
        return replace(self, rubs=np.zeros_like(self.rubs))

    def meshing(self, meshed: Array) -> "RunNuisance":
        """The same, with ``meshed`` (runs,)."""
        return replace(self, meshed=meshed)

    @property
    def unmeshed(self) -> "RunNuisance":
        """The same; where in free play a run begins is left to the load's weight."""
        return self.meshing(np.full_like(self.meshed, np.nan))

    @property
    def is_meshed(self) -> bool:
        """Whether it is told of any run where in free play that begins."""
        return not bool(np.isnan(self.meshed).all())
