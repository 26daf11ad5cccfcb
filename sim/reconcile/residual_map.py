"""The gap on the held-out log, by run, speed, position and time."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Log, Run
from sim.estimation.measurements import MIN_SAMPLES, RunMeasurements, estimate_noise, measure_runs
from sim.gap import GapMap, Residuals, map_gap


def map_residuals(
    log: Log, tracks: Sequence[Array], *, compared: Sequence[NDArray[np.bool_]] = (), floor: float
) -> GapMap | None:
    """The binned residuals of a simulation; None if it diverged or nothing is compared.

    Args:
        log: the measured runs.
        tracks: for each run with at least ``MIN_SAMPLES`` samples, (n, 2) simulated position and
            velocity [SI].
        compared: for each of these runs, (n,) which samples count; empty: all of them.
        floor: [unit/s] noise of the velocity.
    """
    runs = tuple(run for run in log.runs if len(run) >= MIN_SAMPLES)
    measurements = measure_runs(replace(log, runs=runs), friction=None, rest_by_position=False)
    counts = compared or [np.ones(len(run), dtype=bool) for run in runs]
    rows = zip(runs, measurements, tracks, counts, strict=True)
    residuals = [_run_residuals(*one) for one in rows]
    if not (floor > 0.0 and any(one.compared.any() for one in residuals)):
        return None
    return map_gap(residuals, noise=replace(estimate_noise(measurements), velocity=floor))


def _run_residuals(
    run: Run, measurements: RunMeasurements, track: Array, counts: NDArray[np.bool_]
) -> Residuals:
    """The residuals of a run; nan where no sample counts or the simulation diverged."""
    errors = measurements.measured - track
    errors[~counts | ~np.isfinite(track).all(axis=1)] = np.nan
    return Residuals(run.test, run.time, run.voltage, np.nan_to_num(track), errors)
