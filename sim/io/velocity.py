"""Velocities that were logged wrongly: scaled ones, and positions logged as velocity.

A log that says position and velocity says the speed twice, so that each can be checked against the
other.
"""

from dataclasses import replace

import numpy as np

from sim.core.doubt import Doubt
from sim.core.log import Array, Log, Run

SAME = 0.02  # [share of its spread] a velocity nearer to a straight line of the position is it
UNLIKE = 0.3  # [the same] farther than this from the slope of the position it is no velocity
SCALE = 0.1  # by so much the velocity's integral may differ from the way that the position went
SLOWEST = 1.0  # [s] between samples; other clocks do not tell seconds
FEWEST = 10  # samples of a log of which anything is said
PAUSED = 2.5  # [frames] a position that stays longer stands still; a shorter time is one frame


def scale_velocity(log: Log, factor: float) -> Log:
    """The log with all velocities times a factor."""
    return replace(
        log, runs=tuple(replace(run, velocity=factor * run.velocity) for run in log.runs)
    )


def differentiate_position(log: Log) -> Log:
    """The log with each velocity replaced by the slope of the position.

    A slope over the last frame is the mean velocity of that frame, as a motor controller with a
    short filter reports it; a fit finds the length of the frame and allows for it.
    """
    return replace(
        log, runs=tuple(replace(run, velocity=compute_position_slope(run)) for run in log.runs)
    )


def compute_position_slope(run: Run) -> Array:
    """(n,) [m/s or rad/s] how fast the position changed within the last frame of its sensor.

    A loop faster than the sensor logs each reading several times. Only the first of them counts,
    and the slope is taken from reading to reading.
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
    """The log, a velocity that copies the position replaced, a scaled one doubted.

    Returns:
        The same log, or with the slope of the position for a velocity that is the position itself,
        and a doubt that says what was found.
    """
    runs = [run for run in log.runs if len(run) > FEWEST]
    if not runs:
        return log
    position, velocity = (
        np.concatenate([getattr(run, name) for run in runs]) for name in ("position", "velocity")
    )
    slope = np.concatenate([compute_position_slope(run) for run in runs])
    if _off_line(velocity, position) < SAME and _off_line(velocity, slope) > UNLIKE:
        doubt = Doubt(
            "velocity-is-position",
            f"{log.source}: the log has the position in place of the velocity, so the slope of the "
            "position was taken for the velocity. Log the velocity in the robot's code.",
        )
        return differentiate_position(log).add_doubts(doubt)
    if max(float(np.median(np.diff(run.time))) for run in runs) > SLOWEST:
        return log  # its times are no seconds, and so its velocities look scaled
    share = _scale(runs)
    if share is None or abs(share - 1.0) <= SCALE:
        return log
    doubt = Doubt(
        "velocity-scale",
        f"{log.source}: the velocity is {share:.3g} times as fast as the position moves. Look "
        "at the factors of both in the robot's code. If the position is right, add "
        f"--velocity-scale {1.0 / share:.3g} or --ignore-velocity.",
    )
    return log.add_doubts(doubt)


def _off_line(values: Array, line: Array) -> float:
    """[share of the spread] how far values are from the straight line of others nearest to them."""
    spread = float(np.linalg.norm(values - values.mean()))
    centered = line - line.mean()
    size = float(centered @ centered)
    if spread == 0.0 or size == 0.0:
        return 1.0
    rest = values - values.mean() - centered * float(centered @ (values - values.mean())) / size
    return float(np.linalg.norm(rest)) / spread


def _scale(runs: list[Run]) -> float | None:
    """The velocity's integral over the way that the position went; None where nothing moved."""
    ways = np.array([run.position[-1] - run.position[0] for run in runs])
    sums = np.array(
        [0.5 * np.diff(run.time) @ (run.velocity[1:] + run.velocity[:-1]) for run in runs]
    )
    size = float(ways @ ways)
    step = max(float(np.ptp(run.position)) for run in runs)
    return float(sums @ ways) / size if size > (0.5 * step) ** 2 > 0.0 else None
