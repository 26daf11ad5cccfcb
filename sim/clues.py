"""What a detective may look at: a log, and what follows from it, each computed once when asked for.

Everything here is robust: one bad stretch must not bend what the rest of the log says.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sim.log import Array, Log


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
