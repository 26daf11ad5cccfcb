"""Motion that a recorder wrote incompletely, and what replaces it.

Position and velocity both contain the motion, so one can replace the other. Only an arm needs its
position: gravity depends on the angle. A truncated velocity is refined by the position, and the
moment in which an arm falls onto its stop as a test begins is left out.
"""

from dataclasses import replace

import numpy as np

from sim.core.doubt import Doubt
from sim.core.errors import BadSample
from sim.core.log import AT_REST, Array, Log, Run, integrate_velocity
from sim.core.units import find_unit

SAME = 0.02  # [share of its spread] a velocity nearer to a line of the position is a position
UNLIKE = 0.3  # [share of its spread] farther from the slope of the position, it is no velocity
MIN_SAMPLES = 10  # [samples] shorter runs are not checked
COARSE = 0.02  # [share of the top speed] least step of a velocity that is checked for truncation
WHOLE = 1e-3  # [steps] by which a reading may differ from a whole number of steps
CUT = 0.25, 0.75  # [steps] mean of what a truncation cuts off: half a step; rounding cuts off none
FALLING = ("arm", "elevator")  # types that gravity moves
NEAR = 0.05  # [share of a run's way] from its start: farther is no fall onto a stop
FELL = 0.01  # [share of a run's way] least way of a fall
RESTED = 5  # samples of a fall, and of the rest after it, at least
PAUSED = 2.5  # [frames] a position that is constant for longer stands still
COPIED = "velocity-is-position"  # code of the doubt
MADE_FROM = {"position": "the sum of the velocity", "velocity": "the slope of the position"}
"""Signal -> what replaces it."""


def scale_velocity(log: Log, factor: float) -> Log:
    """The log with all velocities times a factor."""
    return replace(
        log, runs=tuple(replace(run, velocity=factor * run.velocity) for run in log.runs)
    )


def differentiate_position(log: Log) -> Log:
    """The log with each velocity replaced by the slope of the position."""
    return replace(
        log,
        runs=tuple(
            replace(run, velocity=compute_position_slope(run.time, run.position))
            for run in log.runs
        ),
    )


def compute_position_slope(time: Array, position: Array) -> Array:
    """The slope of the position within the last frame of its sensor, (n,) [m/s or rad/s].

    The slope over the last frame is the mean velocity of that frame, as a motor controller with a
    short filter reports it. A fit estimates this delay and accounts for it. A loop faster than the
    sensor logs each reading several times; the slope is computed from the first of them.

    Args:
        time: (n,) [s].
        position: (n,) [m or rad].
    """
    if time.size < 2:  # noqa: PLR2004 - a slope needs two
        return np.zeros(time.size)
    fresh = np.flatnonzero(np.diff(position)) + 1
    gaps = np.diff(time[fresh])
    frame = float(np.median(gaps)) if gaps.size else float(np.median(np.diff(time)))
    knots = np.union1d(fresh, (0, time.size - 1))
    paused = np.diff(time[knots], prepend=time[0]) > PAUSED * frame
    knots = np.union1d(knots, np.maximum(knots[paused] - 1, 0))
    before = np.interp(time - frame, time[knots], position[knots])
    now = np.interp(time, time[knots], position[knots])
    slope = (now - before) / np.minimum(frame, np.maximum(time - time[0], 1e-9))
    slope[0] = slope[1]
    return np.asarray(slope, dtype=np.float64)


def mend_motion(log: Log) -> Log:
    """The log, with a doubt for each signal that was replaced.

    A velocity that is the position itself, or that never changes although the position does, is
    replaced by the slope of the position. One that is truncated toward zero gets that slope within
    the step that it leaves open. A position that never changes although the velocity does
    is replaced by the sum of the velocity, except of an arm.
    """
    try:
        return _replace_motion(log)
    except BadSample:  # a slope or a sum that no robot has
        return log


def _replace_motion(log: Log) -> Log:
    """The log as ``mend_motion`` returns it.

    Raises:
        BadSample: a slope or a sum is too large.
    """
    runs = [run for run in log.runs if len(run) > MIN_SAMPLES]
    if not runs:
        return log
    position, velocity = (
        np.concatenate([getattr(run, name) for run in runs]) for name in ("position", "velocity")
    )
    slope = np.concatenate([compute_position_slope(run.time, run.position) for run in runs])
    moves, turns = bool(np.ptp(position)), bool(np.ptp(velocity))
    if turns and not moves and log.type != "arm":
        still = Doubt(
            "position-still",
            f"{log.source}: the position is {position[0]:.4g} from beginning to end, although the "
            f"velocity changes, so {MADE_FROM['position']} was taken for it. Check where the "
            "robot's code gets the position.",
        )
        summed = (
            replace(run, position=integrate_velocity(run.time, run.velocity)) for run in log.runs
        )
        return replace(log, runs=tuple(summed), computed="position").add_doubts(still)
    if moves and not turns:
        code, what = "velocity-still", f"the velocity is {velocity[0]:.4g} from beginning to end"
    elif (
        _measure_linear_residual(velocity, position) < SAME
        and _measure_linear_residual(velocity, slope) > UNLIKE
    ):
        code, what = COPIED, "the log has the position in place of the velocity"
    elif step := find_truncation(log):
        return _refine_truncated(log, step)
    else:
        return log
    doubt = Doubt(
        code,
        f"{log.source}: {what}, so {MADE_FROM['velocity']} was taken for the velocity. Log the "
        "velocity as the motor controller reports it.",
    )
    return differentiate_position(log).add_doubts(doubt)


def find_truncation(log: Log) -> float:
    """[m/s or rad/s] The step to which the velocity is truncated toward zero; 0 if it is not.

    All readings are multiples of the step, and the position moves faster by half a step.
    """
    moving = [run for run in log.runs if len(run) > MIN_SAMPLES and run.top_speed > 0.0]
    if not moving:
        return 0.0
    sizes = np.unique(np.abs(np.concatenate([run.velocity for run in moving])))
    steps = np.diff(sizes)
    step = float(steps.max(initial=0.0, where=steps <= 1.5 * np.min(steps, initial=np.inf)))
    if step < COARSE * log.top_speed:
        return 0.0
    counts = sizes / step
    if np.abs(counts - np.round(counts)).max() > WHOLE * max(float(counts[-1]), 1.0):
        return 0.0
    cut = [
        (np.sign(run.velocity) * (compute_position_slope(run.time, run.position) - run.velocity))[
            np.abs(run.velocity) > 1.5 * step
        ]
        for run in moving
    ]
    every = np.concatenate(cut)
    share = float(np.mean(every)) / step if every.size else 0.0
    return step if CUT[0] < share < CUT[1] else 0.0


def _refine_truncated(log: Log, step: float) -> Log:
    """The log with the slope of the position within each step of a truncated velocity."""
    refined = []
    for run in log.runs:
        slope, size = compute_position_slope(run.time, run.position), np.abs(run.velocity)
        low = np.where(size > 0.0, size, -step)
        along = np.clip(np.where(run.velocity < 0.0, -slope, slope), low, size + step)
        refined.append(replace(run, velocity=np.where(run.velocity < 0.0, -along, along)))
    doubt = Doubt(
        "velocity-truncated",
        f"{log.source}: {describe_truncation(log, step)}. Within a step, {MADE_FROM['velocity']} "
        "was taken. Log the velocity as the motor controller reports it.",
    )
    return replace(log, runs=tuple(refined)).add_doubts(doubt)


def describe_truncation(log: Log, step: float) -> str:
    """The words that a velocity is truncated to steps of ``step`` [m/s or rad/s]."""
    per = find_unit(log.units)
    return (
        f"the velocity is truncated toward zero to steps of {step / per.si:.3g} {per.symbol}/s, "
        f"{step / log.top_speed:.0%} of the top speed"
    )


def leave_out_falls(log: Log) -> Log:
    """The log without the moments in which an arm or elevator falls onto its stop as a test begins.

    One that coasts before a test lies on its stop or, held by friction, a little above. From there
    it may fall, against the voltage that drives it later. A doubt names the tests.
    """
    starts = [find_landing(run) if log.type in FALLING else 0 for run in log.runs]
    if not any(starts):
        return log
    runs = tuple(
        run.select(slice(start, None)) if start else run
        for run, start in zip(log.runs, starts, strict=True)
    )
    tests = " and ".join(run.test for run, start in zip(log.runs, starts, strict=True) if start)
    doubt = Doubt(
        "falls-first",
        f"{log.source}: as {tests} begins, the mechanism falls onto its stop, against the voltage. "
        "This was left out. Let it lie on the stop before you start the test.",
    )
    return replace(log, runs=runs).add_doubts(doubt)


def find_landing(run: Run) -> int:
    """Index of the sample from which a mechanism rests that fell as its test began; 0 if none."""
    if len(run) < MIN_SAMPLES:
        return 0
    far = int(np.argmax(np.abs(run.position - run.position[:1]) > NEAR * np.ptp(run.position)))
    speed = run.velocity[:far] * np.sign(run.voltage[far] if far else 0.0)
    fell = np.flatnonzero(speed < -AT_REST * run.top_speed)
    if fell.size < RESTED or abs(run.velocity[0]) > AT_REST * run.top_speed:
        return 0
    after = int(fell[-1]) + 1
    way = (run.position[0] - run.position[after]) * np.sign(run.voltage[far])
    if way < FELL * np.ptp(run.position):  # noise of a velocity at rest moves nothing
        return 0
    still = np.abs(run.velocity[after:far]) < AT_REST * run.top_speed
    if still.size < RESTED:
        return 0
    rests = np.flatnonzero(np.convolve(still, np.ones(RESTED), mode="valid") >= RESTED)
    return after + int(rests[0]) if rests.size else 0


def _measure_linear_residual(values: Array, line: Array) -> float:
    """RMS distance of values from the best linear function of ``line``, relative to spread."""
    spread = float(np.linalg.norm(values - values.mean()))
    centered = line - line.mean()
    size = float(centered @ centered)
    if spread == 0.0 or size == 0.0:
        return 1.0
    residual = values - values.mean() - centered * float(centered @ (values - values.mean())) / size
    return float(np.linalg.norm(residual)) / spread
