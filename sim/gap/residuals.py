"""The residuals of one run: measured minus predicted."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array

JUMP = 0.2  # [share of the largest voltage] change between two samples that is a step
QUIET = 0.25  # [share of the step] that the voltage may change before and after it


@dataclass(frozen=True, eq=False)
class Residuals:
    """The residuals of one run: of an open-loop simulation, or innovations.

    Args:
        test: name of the test.
        time: (n,) [s] on any clock.
        voltage: (n,) [V].
        predicted: (n, 2) [unit, unit/s] predicted position and velocity. The residuals are binned
            by these: with measured values, their noise would bias the means.
        error: (n,) [unit/s] measured minus predicted velocity; nan where it is not compared.
    """

    test: str
    time: Array
    voltage: Array
    predicted: Array
    error: Array

    @cached_property
    def compared(self) -> NDArray[np.bool_]:
        """(n,) whether a velocity is compared."""
        return np.asarray(~np.isnan(self.error))

    @cached_property
    def run_time(self) -> Array:
        """(n,) [s] since the run began."""
        return np.asarray(self.time - self.time[0])

    def find_steps(self, *, largest: float, still: float) -> tuple[Array, Array]:
        """(n,) [s] since the last voltage step, nan before one; and (n,) its direction, ±1.

        Before and after a step the voltage hardly changes, unlike in a chirp.

        Args:
            largest: [V] largest voltage of all runs.
            still: [unit/s] a slower mechanism is at rest. A run that begins at rest begins with a
                step from 0 V, one that begins in motion does not.
        """
        before = 0.0 if abs(self.predicted[0, 1]) <= still else self.voltage[0]
        change = np.diff(self.voltage, prepend=before)
        sizes = np.abs(np.concatenate(([0.0], change, [0.0])))
        calm = np.maximum(sizes[:-2], sizes[2:]) < QUIET * np.abs(change)
        at = np.flatnonzero((np.abs(change) > JUMP * largest) & calm)
        if not at.size:
            return np.full(self.time.size, np.nan), np.ones(self.time.size)
        last = np.searchsorted(at, np.arange(self.time.size), side="right") - 1
        jump = at[np.maximum(last, 0)]
        since = np.where(last >= 0, self.time - self.time[jump], np.nan)
        return since, np.sign(change[jump])
