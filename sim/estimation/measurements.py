"""The measurements of a log: fresh samples, their noise, and where each test begins.

A reading that repeats because no new frame has come is no measurement. Noise is estimated without a
model, from third differences, which are almost zero for a smooth motion:

    σ = 1.4826·median|x₃ - 3 x₂ + 3 x₁ - x₀|/√20        (the standard deviation of normal noise)
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Log, Run
from sim.core.units import ROBUST

MIN_SAMPLES = 4  # of a run that can be compared: fewer have no third difference
REPEATED = 0.3  # [share of fast samples] if more repeat the one before, the log repeats frames
FAST = 0.3  # [share of a run's top speed] above it every fresh reading differs from the last
FRAME_QUANTILE = 0.2  # quantile of the gaps between changes that is the length of a frame
DIGITS = 1e-7  # [share of the range] finer than the resolution of any log
SINGLE = 2.0**-22  # [share of the range] two roundings of single precision
THIRD = 20.0  # sum of the squares of 1, 3, 3, 1
STOP_GIVES = 0.03  # [share of the way] farther than a mechanism moves while it leans on a stop
CREEP_WAY = 0.005  # [share of the way] less is no creep on a soft stop
CREEP_BEGIN = 0.2  # [share of the crept way] after which a creep has begun
CREEP_TIME = 1.0  # [s] that a creep lasts at least
REST_STEPS = 1.5  # [sensor steps] by which positions at rest may differ
RISE = 0.06  # [s] from the first voltage of a step to the first motion that a late sensor shows
FILTERED = 0.3  # [s] by which an averaged velocity may be late
MOSTLY = 0.98  # [share of samples] if more velocities are not zero, the sensor is noisy at rest
AROUND = 5  # samples before and after a motion that show when it began and ended
LEAST_SPEED = 0.01  # [share of the top speed] slower is at rest, if the position agrees
NOISY = 0.3  # [of that speed] a velocity with more noise at rest does not show what moves
FINE = 3.0  # [sensor steps] of a position between two samples at speed, which then must differ
JUMP = 0.1  # [V] a larger change of voltage is a step, which a mean would smear
UNKNOWN = 1e3  # [m or rad] standard deviation of a position that is not measured
OUTLIER = 4.0  # [standard deviations] that noise hardly ever exceeds
SPEED_CLASSES = 8  # classes of speed in which the noise of a velocity is estimated
UNEVEN = 3.0  # [1] ratio of the noise at high and low speed from which noise depends on the speed


@dataclass(frozen=True, eq=False)
class RunMeasurements:
    """The measurements of one run.

    Args:
        time: (n,) [s].
        voltage: (n,) [V] applied voltage.
        voltage_slide: (n,) [V] linear change until the next sample; 0 is a zero-order hold.
        voltage_error: (n,) [V] standard deviation of the mean voltage until the next sample.
        measured: (n, 2) position and velocity, nan where they are not fresh.
        moving: (n,) whether the mechanism moves.
        informative: (n,) whether a sample is compared: the mechanism moves, or is about to. This
            must not depend on a model, or leaving samples out could make a model likelier.
        at_rest: (n,) whether the position repeats the one read at rest, with the same rounding
            error: such samples are no independent measurements.
        position: [m or rad] at the start.
        velocity: [m/s or rad/s] at the start.
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
        resolution: [m or rad], [m/s or rad/s] least standard deviations, far below the step of any
            sensor, so that a variance is never zero.
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
        friction: [V] about kS, for a mechanism with gravity, which may lean on a stop before it
            moves: the samples are cut off at which friction could not hold it. None cuts nothing.
        rest_by_position: whether the position decides what is at rest if the velocity is noisy at
            rest. False keeps every sample that the velocity alone calls motion, for a model with
            effects, which is judged by how it leaves its rest.
    """
    top = log.top_speed
    runs = [run for run in log.runs if len(run) >= MIN_SAMPLES]
    step = find_sensor_step([run.position for run in runs])
    fresh = [_select_fresh_readings(run, step=step) for run in runs]
    if log.computed == "position":  # it would count the velocity's readings twice
        for readings in fresh:
            readings[:, 0] = np.nan

    def measure(noise: SensorNoise | None = None) -> tuple[RunMeasurements, ...]:
        return tuple(
            _measure_run(run, one, top=top, step=step, friction=friction, noise=noise)
            for run, one in zip(runs, fresh, strict=True)
        )

    measurements = measure()
    noise = estimate_noise(measurements) if measurements and rest_by_position else None
    speed = LEAST_SPEED * top
    if noise is None or _measure_noise_at_rest(runs, speed=speed, noise=noise) <= NOISY * speed:
        return measurements
    return measure(noise)


def bend_voltage(slides: Array) -> Array:
    """(n,) [V] mean of a sliding voltage until the next sample, minus that of a straight line.

    A cubic through the four samples around two of them lies above their straight line by a 24th of
    the change of slope, in the mean. It is 0 where the voltage is held before, there or after.

    Args:
        slides: (n,) [V] linear change of the voltage until the next sample; 0 where it is held.
    """
    before, after = np.append(0.0, slides[:-1]), np.append(slides[1:], 0.0)
    smooth = (before != 0.0) & (slides != 0.0) & (after != 0.0)
    return np.where(smooth, (before - after) / 24.0, 0.0)


def merge_stale_samples(measurements: RunMeasurements) -> RunMeasurements:
    """A copy without the samples at which no reading is fresh.

    A logger that is faster than its sensor repeats readings; simulating them adds no information.
    The voltage of removed samples is averaged; a sample at which it jumps is kept.
    """
    kept = np.asarray(~np.isnan(measurements.measured).all(axis=1))
    kept[0] = kept[-1] = True
    kept[1:] |= np.abs(np.diff(measurements.voltage)) > JUMP
    if kept.all():
        return measurements
    lasts = np.diff(measurements.time, append=measurements.time[-1])
    first = np.flatnonzero(kept)
    share = np.add.reduceat(lasts, first)
    span = np.where(share > 0.0, share, 1.0)
    slide = np.add.reduceat(measurements.voltage_slide, first)
    mean = measurements.voltage + 0.5 * measurements.voltage_slide
    volts = np.add.reduceat(mean * lasts, first) / span - 0.5 * slide
    error = np.sqrt(np.add.reduceat((measurements.voltage_error * lasts) ** 2, first)) / span
    names = ("time", "measured", "moving", "informative", "at_rest")
    return replace(
        measurements, voltage=np.where(share > 0.0, volts, measurements.voltage[kept]),
        voltage_slide=slide, voltage_error=error,
        **{name: getattr(measurements, name)[kept] for name in names},
    )  # fmt: skip


def estimate_noise(measurements: tuple[RunMeasurements, ...]) -> SensorNoise:
    """Standard deviations of the fresh samples while the mechanism moves, over all runs."""
    sizes, ranges = [], []
    for column in (0, 1):
        fresh = list(_list_moving_readings(measurements, column))
        spread = compute_noise_deviation([compute_third_differences(*one) for one in fresh])
        step = find_sensor_step([values for _, values in fresh])
        sizes.append(max(spread, step / math.sqrt(12.0), 1e-12))  # the deviation of rounding
        every = np.concatenate([run.measured[:, column] for run in measurements])
        every = every[~np.isnan(every)]
        ranges.append(float(np.ptp(every)) if every.size else 0.0)
    position = sizes[0] if ranges[0] else UNKNOWN  # without positions nothing is known of them
    x, v = (DIGITS * span + 1e-12 for span in ranges)
    return SensorNoise(position, sizes[1], (x, v))


def _list_moving_readings(
    measurements: Sequence[RunMeasurements], column: int
) -> Iterator[tuple[Array, Array]]:
    """Times and fresh readings in motion, of each run that has enough of them."""
    for run in measurements:
        there = run.moving & ~np.isnan(run.measured[:, column])
        if np.count_nonzero(there) >= MIN_SAMPLES:
            yield run.time[there], run.measured[there, column]


def compute_noise_at_speed(measurements: Sequence[RunMeasurements], noise: SensorNoise) -> float:
    """[unit/s] Root mean square of the velocity's noise, where that noise grows with the speed.

    A velocity that a device computes from the time between two edges of an encoder is off by a
    share of the speed. The noise is measured in equally large classes of speed, of which each has
    at least the noise of the slower ones.

    Args:
        measurements: the runs.
        noise: noise of all samples together; its velocity is returned if the noise does not grow.
    """
    every, speeds = [np.zeros(0)], [np.zeros(0)]
    for time, velocity in _list_moving_readings(measurements, 1):
        every.append(compute_third_differences(time, velocity))
        speeds.append(np.abs(velocity[1:-2] + velocity[2:-1]))
    order = np.argsort(np.concatenate(speeds), kind="stable")
    classes = np.array_split(np.concatenate(every)[order], SPEED_CLASSES)
    if not classes[-1].size:
        return noise.velocity
    least = noise.resolution[1]
    sizes = [compute_noise_deviation([one]) for one in classes]
    grown = np.maximum.accumulate(np.maximum(sizes, least))
    grows = grown[-1] >= UNEVEN * grown[0]
    return float(np.sqrt(np.mean(np.square(grown)))) if grows else noise.velocity


def find_sensor_step(values: Sequence[Array]) -> float:
    """[unit] smallest difference of two readings of all runs: the step of the sensor.

    Differences of single precision's rounding are left out: they are the same sensor count.
    """
    if not values:
        return 0.0
    steps = np.diff(np.sort(np.concatenate(values)))
    steps = steps[steps > SINGLE * float(np.sum(steps))]
    return float(steps.min()) if steps.size else 0.0


def compute_noise_deviation(thirds: Sequence[Array]) -> float:
    """[unit] Standard deviation of noise, from third differences of some runs; 0 without any."""
    every = np.concatenate([np.zeros(0), *thirds])
    return ROBUST * float(np.median(np.abs(every))) / math.sqrt(THIRD) if every.size else 0.0


def compute_third_differences(time: Array, values: Array) -> Array:
    """(n - 3,) third differences of values, all with the same noise variance.

    With evenly spaced times the weights are 1, -3, 3, -1. With others they are those of a divided
    difference, scaled so that independent noise has the same variance in it: 20 times its own.

    Args:
        time: (n,) [s].
        values: (n,) in any unit, which the result has, too.
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
        run: the run.
        step: [unit] step of the position sensor.
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
        run: the run.
        measured: (n, 2) its fresh readings.
        top: [unit/s] the log's top speed.
        step: [unit] step of the position sensor.
        friction: as in ``measure_runs``.
        noise: noise of the samples, if the position decides what is at rest; else None.
    """
    least = LEAST_SPEED * top
    progress = np.zeros(len(run), dtype=bool)
    if noise is not None:
        progress = _find_progress(run, speed=least, noise=noise)
        least += OUTLIER * noise.velocity
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
    voltage = run.voltage + bend_voltage(run.voltage_slide)
    return RunMeasurements(
        run.time[cut], voltage[cut], run.voltage_slide[cut], run.voltage_error[cut],
        np.ascontiguousarray(measured[cut]), moving[cut],
        _find_informative(run, moving)[cut], _find_rest_readings(run, moving)[cut],
        float(run.position[first]), start,
    )  # fmt: skip


def _measure_noise_at_rest(runs: Sequence[Run], *, speed: float, noise: SensorNoise) -> float:
    """[m/s or rad/s] standard deviation of the velocity while the position does not change."""
    thirds = []
    for run in runs:
        rest = ~_find_progress(run, speed=speed, noise=noise)
        four = rest[:-3] & rest[1:-2] & rest[2:-1] & rest[3:]
        thirds.append(compute_third_differences(run.time, run.velocity)[four])
    return compute_noise_deviation(thirds)


def _find_progress(run: Run, *, speed: float, noise: SensorNoise) -> NDArray[np.bool_]:
    """(n,) whether the position changes faster than ``speed``, over two samples to each side."""
    index = np.arange(len(run))
    before, after = np.maximum(index - 2, 0), np.minimum(index + 2, len(run) - 1)
    way = np.abs(run.position[after] - run.position[before])
    least = speed * (run.time[after] - run.time[before]) + OUTLIER * noise.position
    return np.asarray(way > least)


def _find_fresh_readings(values: Array, *, fast: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n,) whether a reading is new: it changes, or a frame has passed since the last new one.

    A coarse sensor may read the same in the next frame, and that is a measurement, too. Only the
    readings at which it changes would be biased: there its rounding error is half a step.
    """
    new = np.concatenate(([True], np.diff(values) != 0.0))
    pairs = fast[1:] & fast[:-1]
    if not pairs.any() or float(np.mean(~new[1:][pairs])) <= REPEATED:
        return np.ones(values.size, dtype=bool)
    at = np.flatnonzero(new[1:] & pairs) + 1
    frame = round(float(np.quantile(np.diff(at), FRAME_QUANTILE))) if at.size > 1 else values.size
    index = np.arange(values.size)
    last = np.maximum.accumulate(np.where(new, index, 0))
    ends = np.append(np.flatnonzero(new)[1:], values.size)[np.cumsum(new) - 1]
    whole = (index - last) % max(frame, 1) == 0
    return np.asarray(new | (whole & (ends - index > 0.5 * frame)))


def _find_repeated_frames(run: Run, *, fast: NDArray[np.bool_], step: float) -> NDArray[np.bool_]:
    """(n,) whether a reading is one of two of the same frame at speed: one of them is too old.

    If the loop and the device's frames have the same period, a little jitter makes the loop read a
    frame twice and miss the next one. Which of the two is too old is unknown.
    """
    ways, pairs = np.abs(np.diff(run.position)), fast[1:] & fast[:-1]
    same = (ways == 0.0) & (np.diff(run.velocity) == 0.0) & pairs
    # a coarse sensor repeats by rounding
    coarse = not pairs.any() or float(np.median(ways[pairs])) < FINE * step
    if coarse or float(np.mean(same[pairs])) > REPEATED:
        same[:] = False
    return np.asarray(np.append(same, False) | np.insert(same, 0, False))


def _find_departure(run: Run, moving: NDArray[np.bool_], *, step: float) -> int:
    """Index of the sample at which the mechanism leaves its start for good.

    A small motion while it leans on a stop does not count. An averaged velocity shows a departure
    late; then the position shows when it was.
    """
    rests = np.flatnonzero(~moving[: _find_far_sample(run) + 1])
    go = int(rests[-1]) + 1 if rests.size else 0
    way = np.abs(run.position[:go] - run.position[0])
    still = np.flatnonzero(way <= REST_STEPS * step)
    left = int(still[-1]) + 1 if still.size else go
    return left if left < go and run.time[go] - run.time[left] < FILTERED else go


def _find_step_begin(run: Run, go: int) -> int:
    """Index of the first sample of the voltage step that makes the mechanism leave at ``go``.

    A current limit lets a step rise over some samples, and late readings show the motion later.
    """
    early = np.arange(go + 1)[run.time[: go + 1] >= run.time[go] - RISE]
    pushes = run.voltage[early] * np.sign(run.voltage[go]) >= 0.5 * abs(run.voltage[go])
    first = 0 if pushes.all() else early.size - int(np.argmin(pushes[::-1]))
    return int(early[first])


def _find_far_sample(run: Run) -> int:
    """Index of the first sample that is farther from the start than any stop gives way."""
    far = np.abs(run.position - run.position[0]) > STOP_GIVES * float(np.ptp(run.position))
    return int(np.argmax(far))


def _creeps_before_leaving(run: Run, go: int) -> bool:
    """Whether it creeps before it leaves: off a rubber stop, or while a chain stretches.

    Such a stop holds it back longer than friction and weight would, so the voltage at which it
    leaves says nothing about either.
    """
    way = np.abs(run.position[: go + 1] - run.position[0])
    creeps = run.time[go] - run.time[int(np.argmax(way > CREEP_BEGIN * way[-1]))]
    return bool(way[-1] > CREEP_WAY * float(np.ptp(run.position)) and creeps > CREEP_TIME)


def _find_sensor_activity(run: Run, moving: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n,) whether the velocity is not zero; if it is noisy at rest, whether it moves."""
    nonzero = np.abs(run.velocity) > 0.0
    return np.asarray(nonzero if nonzero.mean() < MOSTLY else moving)


def _find_informative(run: Run, moving: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n,) whether the mechanism moves, or a sample nearby has a velocity that is not zero."""
    active = _find_sensor_activity(run, moving)
    wide = np.convolve(active, np.ones(2 * AROUND + 1), mode="same")[: len(run)] > 0.0
    return np.asarray(wide | moving)


def _find_rest_readings(run: Run, moving: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n,) whether a position is within the sensor step that is read at rest.

    During a motion through a whole step of the sensor the rounding error averages to zero. From
    rest the mechanism passes only a part of a step, and all readings there have errors of one sign.
    """
    step = np.cumsum(np.diff(run.position, prepend=run.position[:1]) != 0.0)
    rests = np.bincount(step, weights=~_find_sensor_activity(run, moving)) > 0.0
    repeats = np.bincount(step) > 1  # a reading with noise of its own is a measurement
    return np.asarray((rests & repeats)[step])
