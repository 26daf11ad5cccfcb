"""What a detective may look at: a log, and what follows from it, each computed once when asked for.

Everything here is robust: one bad stretch must not bend what the rest of the log says.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from sim.log import Array, Log, Run

MOVING = 0.1  # [share of a run's top speed] slower samples say little about how it moves
Flags: TypeAlias = NDArray[np.bool_]
Counts: TypeAlias = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Clues:
    """A log under investigation.

    Args:
        log: the record.
    """

    log: Log

    @cached_property
    def period(self) -> float:
        """[s] median time between two samples of a run; nan if no run has two."""
        steps = [np.diff(run.time) for run in self.log.runs if len(run) > 1]
        return float(np.median(np.concatenate(steps))) if steps else float("nan")

    @cached_property
    def slopes(self) -> tuple[Array, ...]:
        """Per run, (n,) [m/s or rad/s]: the velocity that its positions tell, by central steps."""
        return tuple(
            np.gradient(run.position, run.time) if len(run) > 1 else np.zeros(len(run))
            for run in self.log.runs
        )

    @cached_property
    def moving(self) -> tuple[Flags, ...]:
        """Per run, (n,): whether it moves, by its velocity; nowhere if it never does."""
        return tuple(np.abs(run.velocity) > MOVING * top_speed(run) for run in self.log.runs)

    @cached_property
    def position_step(self) -> float:
        """[m or rad] the smallest change of a position in the log; inf if none ever changes."""
        return _smallest_step([run.position for run in self.log.runs])

    @cached_property
    def velocity_step(self) -> float:
        """[m/s or rad/s] the smallest change of a velocity in the log; inf if none changes."""
        return _smallest_step([run.velocity for run in self.log.runs])


def top_speed(run: Run) -> float:
    """[m/s or rad/s] the speed of the fastest samples of a run, whatever a single one says."""
    return float(np.percentile(np.abs(run.velocity), 98)) if len(run) else 0.0


def holds(values: Array) -> tuple[Counts, Counts]:
    """Stretches of samples that repeat one value.

    Args:
        values: (n,).

    Returns:
        Where each stretch starts, (m,), and how many samples it is long, (m,).
    """
    starts = np.flatnonzero(np.concatenate(([True], np.diff(values) != 0.0)))
    return starts, np.diff(np.append(starts, values.size))


def _smallest_step(signals: list[Array]) -> float:
    steps = np.concatenate([np.abs(np.diff(values)) for values in signals] or [np.zeros(0)])
    steps = steps[steps > 0.0]
    return float(steps.min()) if steps.size else float("inf")
