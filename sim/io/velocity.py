"""Velocities that were logged wrongly: with a wrong factor, or the position as the velocity.

Position and velocity both contain the speed, so each can be checked against the other.
"""

from dataclasses import replace

import numpy as np

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.log import Array, Log, Run

SAME = 0.02  # [share of its spread] a velocity nearer to a line of the position is a position
UNLIKE = 0.3  # [share of its spread] farther from the slope of the position, it is no velocity
SCALE = 0.1  # [1] relative difference of the velocity's integral from the change of the position
SLOWEST = 1.0  # [s] between samples; larger times are probably not in seconds
FEWEST = 10  # [samples] shorter runs are not checked
PAUSED = 2.5  # [frames] a position that is constant for longer stands still


def scale_velocity(log: Log, factor: float) -> Log:
    """The log with all velocities times a factor."""
    return replace(
        log, runs=tuple(replace(run, velocity=factor * run.velocity) for run in log.runs)
    )


def differentiate_position(log: Log) -> Log:
    """The log with each velocity replaced by the slope of the position.

    The slope over the last sensor frame is the mean velocity of that frame, as a motor controller
    with a short filter reports it. A fit estimates this delay and accounts for it.
    """
    return replace(
        log, runs=tuple(replace(run, velocity=compute_position_slope(run)) for run in log.runs)
    )


def compute_position_slope(run: Run) -> Array:
    """The slope of the position within the last frame of its sensor, (n,) [m/s or rad/s].

    A loop faster than the sensor logs each reading several times. The slope is computed from the
    first of them.
    """
    if len(run) < 2:  # noqa: PLR2004 - a slope needs two
        return np.zeros(len(run))
    time, position = run.time, run.position
    fresh = np.flatnonzero(np.diff(position)) + 1
    gaps = np.diff(time[fresh])
    frame = float(np.median(gaps)) if gaps.size else float(np.median(np.diff(time)))
    knots = np.union1d(fresh, (0, len(run) - 1))
    paused = np.diff(time[knots], prepend=time[0]) > PAUSED * frame
    knots = np.union1d(knots, np.maximum(knots[paused] - 1, 0))
    before = np.interp(time - frame, time[knots], position[knots])
    now = np.interp(time, time[knots], position[knots])
    slope = (now - before) / np.minimum(frame, np.maximum(time - time[0], 1e-9))
    slope[0] = slope[1]
    return np.asarray(slope, dtype=np.float64)


def check_velocity(log: Log) -> Log:
    """Check the velocities of a log against its positions.

    Returns:
        The log, with a doubt if the velocity has a wrong factor. A velocity that is the position
        itself is replaced by the slope of the position, with a doubt.
    """
    runs = [run for run in log.runs if len(run) > FEWEST]
    if not runs:
        return log
    position, velocity = (
        np.concatenate([getattr(run, name) for run in runs]) for name in ("position", "velocity")
    )
    slope = np.concatenate([compute_position_slope(run) for run in runs])
    if _linear_residual(velocity, position) < SAME and _linear_residual(velocity, slope) > UNLIKE:
        doubt = Doubt(
            "velocity-is-position",
            f"{log.source}: the log has the position in place of the velocity, so the slope of the "
            "position was taken for the velocity. Log the velocity in the robot's code.",
        )
        return differentiate_position(log).add_doubts(doubt)
    if max(float(np.median(np.diff(run.time))) for run in runs) > SLOWEST:
        return log  # its times are probably not in seconds
    share = _estimate_scale(runs)
    if share is None or abs(share - 1.0) <= SCALE:
        return log
    doubt = Doubt(
        "velocity-scale",
        f"{log.source}: the velocity is {share:.3g} times as fast as the position moves. Look "
        "at the factors of both in the robot's code.",
        action=Action("velocity-scale", f"{1.0 / share:.3g}"),
    )
    return log.add_doubts(doubt)


def _linear_residual(values: Array, line: Array) -> float:
    """RMS distance of values from the best linear function of ``line``, relative to spread."""
    spread = float(np.linalg.norm(values - values.mean()))
    centered = line - line.mean()
    size = float(centered @ centered)
    if spread == 0.0 or size == 0.0:
        return 1.0
    residual = values - values.mean() - centered * float(centered @ (values - values.mean())) / size
    return float(np.linalg.norm(residual)) / spread


def _estimate_scale(runs: list[Run]) -> float | None:
    """Ratio of the velocity's integral to the change of the position; None without motion."""
    ways = np.array([run.position[-1] - run.position[0] for run in runs])
    sums = np.array(
        [0.5 * np.diff(run.time) @ (run.velocity[1:] + run.velocity[:-1]) for run in runs]
    )
    size = float(ways @ ways)
    step = max(float(np.ptp(run.position)) for run in runs)
    return float(sums @ ways) / size if size > (0.5 * step) ** 2 > 0.0 else None
