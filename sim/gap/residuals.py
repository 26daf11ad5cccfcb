"""The residuals of one run: measured minus predicted."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array

JUMP = 0.2  # [share of the largest voltage] a change of it, from one sample to the next, is a step
QUIET = 0.25  # [share of that jump] that the voltage may change before and after a step


@dataclass(frozen=True, eq=False)
class Residuals:
    """The residuals of one run: of an open-loop simulation, or innovations.

    Args:
        test: its name.
        time: (n,) [s] on any clock.
        voltage: (n,) [V].
        predicted: (n, 2) [unit, unit/s] position and velocity, as the model has them. What is
            measured is sorted by these alone: sorted by its own noise it would show what is not.
        error: (n, 2) [the same] measured less predicted; nan where nothing is compared.
    """

    test: str
    time: Array
    voltage: Array
    predicted: Array
    error: Array

    @cached_property
    def compared(self) -> NDArray[np.bool_]:
        """(n,) where a position or a velocity is compared."""
        return np.asarray(~np.isnan(self.error).all(axis=1))

    @cached_property
    def run_time(self) -> Array:
        """(n,) [s] since the run began."""
        return np.asarray(self.time - self.time[0])

    def find_steps(self, *, largest: float, still: float) -> tuple[Array, Array]:
        """(n,) [s] since the last voltage step, nan before one; and (n,) its direction, ±1.

        A step stands alone: before and after it the voltage hardly changes, unlike in a chirp.

        Args:
            largest: [V] of all runs.
            still: [unit/s] slower is at rest; a run that begins at rest begins with a step from
                0 V, and one that begins in motion does not.
        """
        before = 0.0 if abs(self.predicted[0, 1]) <= still else self.voltage[0]
        change = np.diff(self.voltage, prepend=before)
        beside = np.abs(np.concatenate(([0.0], change, [0.0])))
        calm = np.maximum(beside[:-2], beside[2:]) < QUIET * np.abs(change)
        at = np.flatnonzero((np.abs(change) > JUMP * largest) & calm)
        if not at.size:
            return np.full(self.time.size, np.nan), np.ones(self.time.size)
        last = np.searchsorted(at, np.arange(self.time.size), side="right") - 1
        jump = at[np.maximum(last, 0)]
        since = np.where(last >= 0, self.time - self.time[jump], np.nan)
        return since, np.sign(change[jump])
