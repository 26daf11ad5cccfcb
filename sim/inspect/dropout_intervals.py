"""The intervals to exclude within a series of voltage dropouts.

An inspection reports a series of dropouts as one interval. If the motor really lost its voltage,
the samples between the dropouts are good: only each dropout is excluded, until the speed has
recovered. If only the record lost the voltage, a simulation of the rest would lack those volts, and
the whole interval is excluded.
"""

import numpy as np

from sim.core.log import Run
from sim.inspect.faults.voltage_dropout import CLEAR, Dropout, find_dropouts, measure_loss


def find_dropout_intervals(
    run: Run, *, start: float, end: float
) -> tuple[tuple[float, float], ...]:
    """Start and end times [s] to exclude; the whole interval where the motion did not react.

    Args:
        run: that was inspected.
        start: [s] on its clock, of the first drop-out.
        end: [s] of the last one's end.
    """
    period = float(np.median(np.diff(run.time)))
    found = [one for one in find_dropouts(run, period) if start <= run.time[one.first] <= end]
    if not found or np.median([measure_loss(run, one)[0] for one in found]) < CLEAR:
        return ((start, end),)
    return tuple(
        (float(run.time[one.first]), float(run.time[_find_recovery(run, one)])) for one in found
    )


def _find_recovery(run: Run, dropout: Dropout) -> int:
    """Index of the first sample after a dropout at which the speed has recovered."""
    _, slowest, before = measure_loss(run, dropout)
    back = np.flatnonzero(np.abs(run.velocity[slowest:]) >= (1.0 - CLEAR) * before)
    return max(dropout.last, slowest + int(back[0])) if back.size else dropout.last
