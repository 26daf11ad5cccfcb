"""Damage to a record, as whoever inspected it tells the solver: the solver knows no faults."""

from dataclasses import dataclass


@dataclass(frozen=True)
class DamagedInterval:
    """A stretch of a run that is not to be believed.

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
