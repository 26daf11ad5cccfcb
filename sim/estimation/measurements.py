"""The measurements of a log: fresh samples, their noise, and where each test begins.

A reading that stands because no new frame has come is no measurement; noise is measured without a
model, from third differences, which a smooth motion hardly has:

    σ = 1.4826·median|x₃ - 3 x₂ + 3 x₁ - x₀|/√20        (of normal noise the standard deviation)
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Log, Run

HELD = 0.3  # [share of fast samples] that repeat the one before them, from which it is frames
FAST = 0.3  # [share of a run's top speed] above which a sensor should say something new each time
SOON = 0.2  # [share of gaps] between changes that are no longer than a frame
DIGITS = 1e-7  # [share of the range] that is below what any log resolves
SINGLE = 2.0**-22  # [share of the range] two roundings of single precision
THIRD = 20.0  # sum of the squares of 1, 3, 3, 1
ROBUST = 1.4826  # standard deviations in a median absolute deviation
GIVES = 0.03  # [share of the way] that a mechanism gives where it leans on a stop
GIVEN, CREPT, CREEPS = 0.005, 0.2, 1.0  # [share of the way, share of that, s] how a stop yields
REST_STEPS = 1.5  # steps of a position by which one at rest may differ
RISES = (
    0.06  # [s] between the first voltage of a step and the first motion that a late sensor shows
)
FILTERED = 0.3  # [s] by which an averaged velocity may be late
MOSTLY = 0.98  # [share of samples] that stir, from which a sensor trembles at rest
AROUND = 5  # samples before a motion and after it that say when it began and ended
MOVING = 0.01  # [share of the top speed] slower counts as standing, if the position agrees
TREMBLES = 0.3  # [of that speed] a velocity with more noise at rest cannot tell it from a motion
FINE = 3.0  # steps of a sensor between two samples at speed, which then cannot be the same
JUMP = 0.1  # [V] a larger change of voltage is a step, which a mean would smear
SURELY = 4.0  # [standard deviations] noise hardly ever goes so far
SPEED_CLASSES = 8  # classes of speed in which the noise of a velocity is measured
UNEVEN = 3.0  # [1] ratio of the noise at high and low speed from which noise depends on the speed


@dataclass(frozen=True, eq=False)
class RunMeasurements:
    """The measurements of one run.

    Args:
        time: (n,) [s].
        voltage: (n,) [V].
        voltage_slide: (n,) [V] linear change until the next sample; 0 is a zero-order hold.
        voltage_error: (n,) [V] standard deviation of its mean until the next sample.
        measured: (n, 2) position and velocity, nan where they are not fresh.
        moving: (n,) where it moves.
        informative: (n,) where it moves, or is about to: what is compared. That must not depend on
            a model, or a model could become likelier by leaving samples out.
        at_rest: (n,) where the position repeats the one read at rest, with the same rounding error:
            such samples are no independent measurements.
        velocity: [m/s or rad/s] it begins with.
        position: [m or rad] it begins at.
    """

    time: Array
    voltage: Array
    voltage_slide: Array
    voltage_error: Array
    measured: Array
    moving: NDArray[np.bool_]
    informative: NDArray[np.bool_]
    at_rest: NDArray[np.bool_]
    position: float
    velocity: float


@dataclass(frozen=True)
class SensorNoise:
    """Standard deviations of single samples, estimated without a model.

    Args:
        position: [m or rad].
        velocity: [m/s or rad/s].
        resolution: [m or rad], [m/s or rad/s] a smallest size, far below the step of any sensor, so
            that a variance is never zero.
    """

    position: float
    velocity: float
    resolution: tuple[float, float]


def measure_runs(
    log: Log, *, friction: float | None, rest_by_position: bool = True
) -> tuple[RunMeasurements, ...]:
    """The measurements of every run that has enough fresh samples.

    Args:
        log: any runs.
        friction: [V] about kS of a mechanism with gravity, which may lean on a stop before it
            moves: then a run begins where friction alone would hold it. None keeps all.
        rest_by_position: whether the position decides what stands where a velocity trembles at
            rest. A model with effects is judged by how it leaves its rest, and keeps every sample
            that the velocity alone calls motion.
    """
    top = log.top_speed
    runs = [run for run in log.runs if len(run) > 3]  # noqa: PLR2004 - fewer have no third difference
    step = _smallest_step([run.position for run in runs])
    fresh = [_select_fresh_readings(run, step=step) for run in runs]

    def measure(noise: SensorNoise | None = None) -> tuple[RunMeasurements, ...]:
        return tuple(
            _measure_run(run, one, top=top, step=step, friction=friction, noise=noise)
            for run, one in zip(runs, fresh, strict=True)
        )

    seen = measure()
    noise = estimate_noise(seen) if seen and rest_by_position else None
    speed = MOVING * top
    if noise is None or _rest_noise(runs, speed=speed, noise=noise) <= TREMBLES * speed:
        return seen
    return measure(noise)


def merge_stale_samples(seen: RunMeasurements) -> RunMeasurements:
    """A copy without the samples at which no reading is fresh.

    A logger that is faster than its sensor repeats readings, and simulating them tells nothing.
    Over samples that are left out the voltage is averaged; where it jumps, a sample stays.
    """
    kept = np.asarray(~np.isnan(seen.measured).all(axis=1))
    kept[0] = kept[-1] = True
    kept[1:] |= np.abs(np.diff(seen.voltage)) > JUMP
    if kept.all():
        return seen
    lasts = np.diff(seen.time, append=seen.time[-1])
    first = np.flatnonzero(kept)
    share = np.add.reduceat(lasts, first)
    span = np.where(share > 0.0, share, 1.0)
    slide = np.add.reduceat(seen.voltage_slide, first)
    mean = seen.voltage + 0.5 * seen.voltage_slide
    volts = np.add.reduceat(mean * lasts, first) / span - 0.5 * slide
    error = np.sqrt(np.add.reduceat((seen.voltage_error * lasts) ** 2, first)) / span
    return RunMeasurements(
        seen.time[kept], np.where(share > 0.0, volts, seen.voltage[kept]), slide, error,
        np.ascontiguousarray(seen.measured[kept]), seen.moving[kept], seen.informative[kept],
        seen.at_rest[kept], seen.position, seen.velocity,
    )  # fmt: skip


def estimate_noise(seen: tuple[RunMeasurements, ...]) -> SensorNoise:
    """Noise of fresh samples while the mechanism moves."""
    thirds: list[list[Array]] = [[], []]
    fresh: list[list[Array]] = [[], []]
    for run in seen:
        for column in (0, 1):
            there = run.moving & ~np.isnan(run.measured[:, column])
            values = run.measured[there, column]
            if values.size > 3:  # noqa: PLR2004 - as above
                thirds[column].append(compute_third_differences(run.time[there], values))
                fresh[column].append(values)
    sizes = []
    for third, values in zip(thirds, fresh, strict=True):
        every = np.concatenate(third) if third else np.zeros(1)
        spread = ROBUST * float(np.median(np.abs(every))) / math.sqrt(THIRD)
        least = _smallest_step(values) / math.sqrt(12.0)  # what rounding leaves
        sizes.append(max(spread, least, 1e-12))
    columns = [np.concatenate([run.measured[:, column] for run in seen]) for column in (0, 1)]
    grain = tuple(DIGITS * float(np.nanmax(one) - np.nanmin(one)) + 1e-12 for one in columns)
    return SensorNoise(sizes[0], sizes[1], (grain[0], grain[1]))


def compute_noise_at_speed(seen: Sequence[RunMeasurements], noise: SensorNoise) -> float:
    """[unit/s] Root mean square of the velocity's noise, where that noise grows with the speed.

    A velocity that a device computes from the time between two edges of an encoder is off by a
    share of the speed. The noise is measured in equally large classes of speed, of which each has
    at least the noise of the slower ones.

    Args:
        seen: the runs.
        noise: of all their samples together, returned where the noise does not grow.
    """
    every, speeds = [np.zeros(0)], [np.zeros(0)]
    for run in seen:
        there = run.moving & ~np.isnan(run.measured[:, 1])
        velocity = run.measured[there, 1]
        if velocity.size > 3:  # noqa: PLR2004 - fewer have no third difference
            every.append(compute_third_differences(run.time[there], velocity))
            speeds.append(np.abs(velocity[1:-2] + velocity[2:-1]))
    order = np.argsort(np.concatenate(speeds), kind="stable")
    classes = np.array_split(np.concatenate(every)[order], SPEED_CLASSES)
    if not classes[-1].size:
        return noise.velocity
    least = noise.resolution[1]
    sizes = [ROBUST * float(np.median(np.abs(one))) / math.sqrt(THIRD) for one in classes]
    grown = np.maximum.accumulate(np.maximum(sizes, least))
    grows = grown[-1] >= UNEVEN * grown[0]
    return float(np.sqrt(np.mean(np.square(grown)))) if grows else noise.velocity


def _smallest_step(values: Sequence[Array]) -> float:
    """[unit] between two different readings, of all runs: what a sensor counts in.

    A device that computes in single precision reads one and the same count as several numbers.
    """
    if not values:
        return 0.0
    steps = np.diff(np.sort(np.concatenate(values)))
    steps = steps[steps > SINGLE * float(np.sum(steps))]
    return float(steps.min()) if steps.size else 0.0


def compute_third_differences(time: Array, values: Array) -> Array:
    """(n - 3,) third differences of values, scaled so that noise adds as on even times.

    With even times these are 1, -3, 3, -1; with others the weights of a divided difference, scaled
    so that independent noise makes as much of them.
    """
    one, two, three = (time[apart:] - time[:-apart] for apart in (1, 2, 3))
    first, middle, last = one[:-2], one[1:-1], one[2:]
    weights = (
        -1.0 / (first * two[:-1] * three),
        1.0 / (first * middle * two[1:]),
        -1.0 / (two[:-1] * middle * last),
        1.0 / (three * two[1:] * last),
    )
    size = np.sqrt(sum(weight**2 for weight in weights) / THIRD)
    summed = sum(weight * values[k : k + size.size] for k, weight in enumerate(weights))
    return np.asarray(summed / size)


def _select_fresh_readings(run: Run, *, step: float) -> Array:
    """(n, 2) position and velocity of a run, nan where they are not fresh.

    Args:
        run: one of a log's.
        step: [unit] between two different positions of the log.
    """
    measured = np.column_stack([run.position, run.velocity])
    fast = np.abs(run.velocity) > FAST * float(np.max(np.abs(run.velocity), initial=0.0))
    doubtful = _find_repeated_frames(run, fast=fast, step=step)
    for column in (0, 1):
        measured[~_find_fresh_readings(measured[:, column], fast=fast), column] = np.nan
    if not np.isnan(measured).any():
        measured[doubtful] = np.nan
    return measured


def _measure_run(
    run: Run, measured: Array, *, top: float, step: float, friction: float | None,
    noise: SensorNoise | None,
) -> RunMeasurements:  # fmt: skip
    """The measurements of a run.

    Args:
        run: one of a log's.
        measured: (n, 2) its fresh readings.
        top: [unit/s] the log's top speed.
        step: [unit] between two different positions of the log.
        friction: as of ``measure_runs``.
        noise: of a velocity which trembles at rest.
    """
    moving = np.abs(run.velocity) > MOVING * top
    least = MOVING * top
    if noise is not None:
        least += SURELY * noise.velocity
        progress = _find_progress(run, speed=MOVING * top, noise=noise)
        moving = (np.abs(run.velocity) > least) | progress
    first = 0
    if friction is not None and moving.any() and not moving[0]:
        go = _find_departure(run, moving, step=step)
        if _creeps_before_leaving(run, go):
            first = _find_far_sample(run)
        else:
            near = np.abs(run.voltage[: go + 1] - run.voltage[go]) <= friction
            first = go + 1 - int(np.argmin(near[::-1])) if not near.all() else 0
            first = min(first, max(go - 1, 0), _find_step_begin(run, go))
    cut = slice(first, None)
    start = float(run.velocity[first])
    start = start if abs(start) > least else 0.0
    return RunMeasurements(
        run.time[cut], run.voltage[cut], run.voltage_slide[cut], run.voltage_error[cut],
        np.ascontiguousarray(measured[cut]), moving[cut],
        _find_informative(run, moving)[cut], _find_rest_readings(run, moving)[cut],
        float(run.position[first]), start,
    )  # fmt: skip


def _rest_noise(runs: Sequence[Run], *, speed: float, noise: SensorNoise) -> float:
    """[m/s or rad/s] standard deviation of the velocity where the position stands."""
    thirds = []
    for run in runs:
        rest = ~_find_progress(run, speed=speed, noise=noise)
        four = rest[:-3] & rest[1:-2] & rest[2:-1] & rest[3:]
        thirds.append(compute_third_differences(run.time, run.velocity)[four])
    every = np.concatenate(thirds)
    return ROBUST * float(np.median(np.abs(every))) / math.sqrt(THIRD) if every.size else 0.0


def _find_progress(run: Run, *, speed: float, noise: SensorNoise) -> NDArray[np.bool_]:
    """(n,) where the position changes at that speed or faster, over two samples to each side."""
    index = np.arange(len(run))
    before, after = np.maximum(index - 2, 0), np.minimum(index + 2, len(run) - 1)
    way = np.abs(run.position[after] - run.position[before])
    least = speed * (run.time[after] - run.time[before]) + SURELY * noise.position
    return np.asarray(way > least)


def _find_fresh_readings(values: Array, *, fast: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n,) where a reading is new: where it changes, and once per frame where it stays.

    A coarse reading may say the same in the next frame, and that is as good as another; one that
    only counts where it changes would count where it is wrong by half a step.
    """
    new = np.concatenate(([True], np.diff(values) != 0.0))
    pairs = fast[1:] & fast[:-1]
    if not pairs.any() or float(np.mean(~new[1:][pairs])) <= HELD:
        return np.ones(values.size, dtype=bool)
    at = np.flatnonzero(new[1:] & pairs) + 1
    frame = round(float(np.quantile(np.diff(at), SOON))) if at.size > 1 else values.size
    index = np.arange(values.size)
    last = np.maximum.accumulate(np.where(new, index, 0))
    ends = np.append(np.flatnonzero(new)[1:], values.size)[np.cumsum(new) - 1]
    whole = (index - last) % max(frame, 1) == 0
    return np.asarray(new | (whole & (ends - index > 0.5 * frame)))


def _find_repeated_frames(run: Run, *, fast: NDArray[np.bool_], step: float) -> NDArray[np.bool_]:
    """(n,) readings of a frame that was read twice at speed: one of the two is a period older.

    Where a loop and a device's frames are in step, a little jitter makes the loop read a frame
    twice and miss the next one. Which of the two has the age of all others, nobody can tell.
    """
    ways, pairs = np.abs(np.diff(run.position)), fast[1:] & fast[:-1]
    same = (ways == 0.0) & (np.diff(run.velocity) == 0.0) & pairs
    coarse = not pairs.any() or float(np.median(ways[pairs])) < FINE * step  # it repeats itself
    if coarse or float(np.mean(same[pairs])) > HELD:
        same[:] = False
    return np.asarray(np.append(same, False) | np.insert(same, 0, False))


def _find_departure(run: Run, moving: NDArray[np.bool_], *, step: float) -> int:
    """The sample at which it leaves for good; leaning on a stop a mechanism only gives a little.

    An averaged velocity shows a departure late; then the position says when it was.
    """
    rests = np.flatnonzero(~moving[: _find_far_sample(run) + 1])
    go = int(rests[-1]) + 1 if rests.size else 0
    way = np.abs(run.position[:go] - run.position[0])
    still = np.flatnonzero(way <= REST_STEPS * step)
    left = int(still[-1]) + 1 if still.size else go
    return left if left < go and run.time[go] - run.time[left] < FILTERED else go


def _find_step_begin(run: Run, go: int) -> int:
    """The first sample of a step that moves a mechanism at ``go``, a little later than commanded.

    A current limit lets a step rise over some samples, and what the first of them did to the motion
    shows later, where readings are late.
    """
    early = np.arange(go + 1)[run.time[: go + 1] >= run.time[go] - RISES]
    pushes = run.voltage[early] * np.sign(run.voltage[go]) >= 0.5 * abs(run.voltage[go])
    return (
        int(early[early.size - int(np.argmin(pushes[::-1]))]) if not pushes.all() else int(early[0])
    )


def _find_far_sample(run: Run) -> int:
    """The sample at which it is farther from where it began than any stop would give."""
    far = np.abs(run.position - run.position[0]) > GIVES * float(np.ptp(run.position))
    return int(np.argmax(far))


def _creeps_before_leaving(run: Run, go: int) -> bool:
    """Whether it creeps before it leaves: pressed onto a stop of rubber, or a chain that gives.

    Such a stop holds it back longer than friction and weight would, so what the voltage was when it
    came off says nothing about either.
    """
    way = np.abs(run.position[: go + 1] - run.position[0])
    creeps = run.time[go] - run.time[int(np.argmax(way > CREPT * way[-1]))]
    return bool(way[-1] > GIVEN * float(np.ptp(run.position)) and creeps > CREEPS)


def _find_sensor_activity(run: Run, moving: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n,) where a sensor that is quiet at rest is not; if it trembles, where it moves."""
    stirs = np.abs(run.velocity) > 0.0
    return np.asarray(stirs if stirs.mean() < MOSTLY else moving)


def _find_informative(run: Run, moving: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n,) where it moves, and a little around where the sensor stirs."""
    wide = (
        np.convolve(_find_sensor_activity(run, moving), np.ones(2 * AROUND + 1), mode="same") > 0.0
    )
    return np.asarray(wide[: len(run)] | moving)


def _find_rest_readings(run: Run, moving: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n,) where a position is what is read at rest, creeping within one step of it included.

    A motion through a whole step of the sensor is read too low as often as too high. From rest it
    only goes through a part of one, and all readings of that part err the same way.
    """
    step = np.cumsum(np.diff(run.position, prepend=run.position[:1]) != 0.0)
    rests = np.bincount(step, weights=~_find_sensor_activity(run, moving)) > 0.0
    repeats = np.bincount(step) > 1  # a reading with noise of its own is a measurement
    return np.asarray((rests & repeats)[step])
