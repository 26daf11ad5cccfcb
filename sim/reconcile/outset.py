"""How runs begin: what no sample tells exactly, or at all."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from sim.log import Array


@dataclass(frozen=True, eq=False)
class Outset:
    """How each run begins.

    Args:
        beside: (runs,) [unit] true position at its first sample, less the one seen there.
        meshed: (runs,) [1] where in its free play the motor is, from -1 to 1; nan where the load's
            weight decides.
    """

    beside: Array
    meshed: Array

    @classmethod
    def seen(cls, runs: int) -> "Outset":
        """Just as the first samples say."""
        return cls(np.zeros(runs), np.full(runs, np.nan))

    def of(self, chosen: Sequence[int]) -> "Outset":
        """That of some runs."""
        places = list(chosen)
        return Outset(self.beside[places], self.meshed[places])

    def moved(self, by: Array) -> "Outset":
        """The same; ``by`` (runs,) [unit] further."""
        return replace(self, beside=self.beside + by)

    def meshing(self, meshed: Array) -> "Outset":
        """The same, with ``meshed`` (runs,)."""
        return replace(self, meshed=meshed)
