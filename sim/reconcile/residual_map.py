"""The gap on the held-out log, by run, speed, position and time."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Log, Run
from sim.estimation.measurements import RunMeasurements, estimate_noise, measure_runs
from sim.estimation.run_records import FEWEST
from sim.gap import GapMap, Residuals, map_gap


def map_residuals(
    log: Log, tracks: Sequence[Array], *, compared: Sequence[NDArray[np.bool_]] = (), floor: float
) -> GapMap | None:
    """The binned residuals of a simulation; None if it diverged or nothing is compared.

    Args:
        log: that is shown.
        tracks: a run of it that has enough samples -> (n, 2) simulated position and velocity, SI.
        compared: the same runs -> (n,) which of their samples count; empty: all of them.
        floor: [unit/s] noise of the velocity.
    """
    runs = tuple(run for run in log.runs if len(run) >= FEWEST)
    seen = measure_runs(replace(log, runs=runs), friction=None, rest_by_position=False)
    counts = compared or [np.ones(len(run), dtype=bool) for run in runs]
    left = [_run_residuals(*one) for one in zip(runs, seen, tracks, counts, strict=True)]
    if not (floor > 0.0 and any(one.compared.any() for one in left)):
        return None
    return map_gap(left, noise=replace(estimate_noise(seen), velocity=floor))


def _run_residuals(
    run: Run, seen: RunMeasurements, track: Array, counts: NDArray[np.bool_]
) -> Residuals:
    """What it leaves of a run's fresh samples."""
    missed = seen.measured - track
    missed[~counts | ~np.isfinite(track).all(axis=1)] = np.nan
    return Residuals(run.test, run.time, run.voltage, np.nan_to_num(track), missed)
