"""Damaged intervals of a log, as an inspection reports them to the solver."""

from dataclasses import dataclass


@dataclass(frozen=True)
class DamagedInterval:
    """An interval of a run that a fault has damaged.

    Args:
        run: which one, from 0; None concerns the whole log.
        start: [s] on the run's own clock.
        end: [s].
        fault: its name.
        confidence: [1] 0 to 1.
        sentence: what was seen.
        advice: what to do.
    """

    run: int | None
    start: float
    end: float
    fault: str
    confidence: float
    sentence: str
    advice: str
