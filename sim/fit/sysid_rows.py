"""Prepare the rows of SysId's regression, step for step as WPILib SysId does.

Source: WPILib SysId 2026.2.2, ``analysis/FilteringUtils`` and ``analysis/AnalysisManager``. If
SysId continues with samples that do not determine the gains, this module raises an error with the
reason. Otherwise the rows are those that SysId uses.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields

import numpy as np

from sim.core.errors import BadRequest, NotIdentifiable
from sim.core.log import FOUR_TESTS, Array, Log, Run

NOISE_WINDOW = 9  # [samples] SysId's noise floor looks at a moving mean this long
LONGEST_GAP = 0.5  # [s] a longer step between samples does not count toward the mean period
MOVED = 0.8  # [share of the peak acceleration] at which the velocity begins to rise
NEAR_TOP = 0.9  # [share of the top speed] up to which a dynamic test determines kA
MEDIAN_WINDOWS = range(1, 16)  # [samples] that SysId's slider offers


@dataclass(frozen=True, eq=False)
class Rows:
    """The samples of one test that the regression uses.

    Args:
        time: (n,) [s].
        period: (n,) [s], from each sample to the next one recorded.
        voltage: (n,) [V].
        position: (n,) [m or rad].
        velocity: (n,) [m/s or rad/s].
        acceleration: (n,) [m/s² or rad/s²].
    """

    time: Array
    period: Array
    voltage: Array
    position: Array
    velocity: Array
    acceleration: Array

    def __len__(self) -> int:
        return int(self.time.size)

    def select(self, keep: "np.ndarray[tuple[int], np.dtype[np.bool_]] | slice") -> "Rows":
        """The rows that a mask or a slice keeps."""
        return Rows(*(getattr(self, one.name)[keep] for one in fields(self)))


@dataclass(frozen=True, eq=False)
class PreparedRows:
    """The rows that the regression and the metrics use.

    Args:
        rows: test name -> filtered and trimmed rows, for the regression.
        raw: test name -> rows as recorded (a quasistatic test without its standstill).
        threshold: [m/s or rad/s] below which a quasistatic sample counts as standstill.
        step_duration: [s] used part of a dynamic test, from its peak acceleration on.
        position_delay: [s] delay from voltage to position, the mean of both dynamic tests.
        velocity_delay: [s] delay from voltage to velocity, the mean of both dynamic tests.
    """

    rows: Mapping[str, Rows]
    raw: Mapping[str, Rows]
    threshold: float
    step_duration: float
    position_delay: float
    velocity_delay: float


def prepare_rows(log: Log, *, median: int = 1) -> PreparedRows:
    """Trim, filter and differentiate the four tests of a log.

    Args:
        log: with at least one run of each of the four tests; the first of each is used.
        median: [samples] window of the median filter on velocity; 1 is none.

    Raises:
        BadRequest: the window is not one SysId offers.
        NotIdentifiable: a test is missing, too short, never moves, or its times make no sense.
    """
    if median not in MEDIAN_WINDOWS:
        raise BadRequest(
            f"a median window of {median} samples is not possible",
            advice=f"Choose {MEDIAN_WINDOWS[0]} (no filter) to {MEDIAN_WINDOWS[-1]}.",
        )
    raw = {test: _make_rows(run) for test, run in _take_first_runs(log).items()}
    threshold = min(
        estimate_noise_floor(raw[t].velocity) for t in FOUR_TESTS if t.startswith("quasi")
    )
    rows: dict[str, Rows] = {}
    duration, delays = 0.0, []
    longest = max(float(np.ptp(raw[test].time)) for test in FOUR_TESTS if test.startswith("dyn"))
    for test in sorted(raw):  # SysId's order: the forward step sets the duration for both
        if test.startswith("quasi"):
            raw[test] = _drop_standstill(raw[test], threshold=threshold, test=test)
        rows[test] = _differentiate(raw[test], median=median, test=test)
        raw[test] = rows[test] if median == 1 else _differentiate(raw[test], median=1, test=test)
        if test.startswith("dyn"):
            step = trim_step(
                rows[test], threshold=threshold, duration=duration, longest=longest, test=test
            )
            rows[test], duration = step.rows, step.duration
            delays.append((step.position_delay, step.velocity_delay))
    position_delay, velocity_delay = np.mean(delays, axis=0)
    return PreparedRows(
        {test: _drop_zero_acceleration(rows[test], test=test) for test in FOUR_TESTS},
        {test: _drop_zero_acceleration(raw[test], test=test) for test in FOUR_TESTS},
        threshold,
        duration,
        float(position_delay),
        float(velocity_delay),
    )


def estimate_noise_floor(velocity: Array) -> float:
    """[m/s or rad/s] RMS deviation of a velocity from its moving mean.

        sqrt( Σ (v[i - step] - mean(v[i - window + 1 … i]))² / (n - step) ),  step = window // 2

    The window is ``NOISE_WINDOW``.

    The history before the first sample counts as zeros. Source: SysId, ``GetNoiseFloor``.

    Args:
        velocity: (n,) [m/s or rad/s], n > window // 2.
    """
    step = NOISE_WINDOW // 2
    summed = np.concatenate((np.zeros(NOISE_WINDOW), np.cumsum(velocity)))
    mean = (summed[NOISE_WINDOW:] - summed[:-NOISE_WINDOW]) / NOISE_WINDOW
    stray = velocity[: velocity.size - step] - mean[step:]
    return float(np.sqrt(stray @ stray / stray.size))


def median_filter(values: Array, *, window: int) -> Array:
    """(n,) centered running median with SysId's treatment of the ends.

    At the start its buffer is filled with the first value, and the next sample that enters it is
    number ``(window - 1) // 2``, so the samples between are not used. After the end the last value
    is repeated.

    Args:
        values: (n,), n >= window.
        window: [samples] length of the window.
    """
    ahead = (window - 1) // 2
    fed = np.concatenate(
        (np.full(window - 1, values[0]), values[ahead:], np.full(ahead, values[-1]))
    )
    return np.asarray(np.median(np.lib.stride_tricks.sliding_window_view(fed, window), axis=1))


@dataclass(frozen=True, eq=False)
class TrimmedStep:
    """A dynamic test cut to the part that determines kA.

    Args:
        rows: the rows from the peak acceleration on, ``duration`` long.
        duration: [s] length of the used part.
        position_delay: [s] from voltage to a change of position; negative if noise is earlier.
        velocity_delay: [s] from voltage to the rise of velocity.
    """

    rows: Rows
    duration: float
    position_delay: float
    velocity_delay: float


def trim_step(
    rows: Rows, *, threshold: float, duration: float, longest: float, test: str = "dynamic"
) -> TrimmedStep:
    """Cut a dynamic test to the part from its peak acceleration to 90 % of its top speed.

    Args:
        rows: the differentiated test.
        threshold: [m/s or rad/s] noise floor: a slower change of position is no motion.
        duration: [s] length of the part; 0 computes it from the data.
        longest: [s] upper limit of the length.
        test: name of the test, for messages.

    Raises:
        NotIdentifiable: no voltage was ever applied.
    """
    if not np.any(rows.voltage):
        raise NotIdentifiable(
            f"{test} never applies a voltage",
            advice="Log the applied voltage, and run the test with the robot enabled.",
        )
    start = int(np.argmax(np.abs(rows.voltage) > 0))
    begin = rows.time[start]
    moved = np.abs(rows.position - rows.position[start]) > threshold * rows.period
    speedup = np.sign(rows.velocity) * rows.acceleration
    peak = int(np.argmax(speedup))
    rising = int(np.argmax(speedup > MOVED * speedup[peak]))
    speed = np.abs(rows.velocity[peak:])
    if duration == 0.0:
        near_top = rows.time[peak + int(np.argmax(speed > NEAR_TOP * speed.max()))]
        duration = float(min(near_top - rows.time[peak] + min(rows.time[peak] - begin, 0), longest))
    cut = rows.select(slice(peak, None))
    return TrimmedStep(
        cut.select(cut.time - cut.time[0] <= duration),
        duration,
        float(rows.time[int(np.argmax(moved))] - begin) if moved.any() else 0.0,
        float(rows.time[rising] - begin),
    )


def _take_first_runs(log: Log) -> dict[str, Run]:
    """The first run of each of the four tests."""
    missing = [test for test in FOUR_TESTS if not log.list_runs_of_test(test)]
    if missing:
        raise NotIdentifiable(
            f"no {' and no '.join(missing)} test in this log",
            where=log.source,
            advice="SysId's recipe needs all four: quasistatic and dynamic, forward and reverse. "
            "Run the missing one, or hold the button longer so that it is logged.",
        )
    return {test: log.list_runs_of_test(test)[0] for test in FOUR_TESTS}


def _make_rows(run: Run) -> Rows:
    """The rows of a run: samples with the time to the next one, so without the last."""
    if len(run) <= NOISE_WINDOW:
        raise NotIdentifiable(
            f"{run.test} has {len(run)} samples, too few to separate motion from noise",
            advice="Hold the button until the mechanism has moved for a second or more.",
        )
    period = np.diff(run.time)
    if not np.any(period < LONGEST_GAP):
        raise NotIdentifiable(
            f"the samples of {run.test} are {np.median(period):.3g} s apart",
            advice="Times look like milliseconds: divide them by 1000 so that they are in seconds.",
        )
    return Rows(
        run.time[:-1],
        period,
        run.voltage[:-1],
        run.position[:-1],
        run.velocity[:-1],
        np.zeros(period.size),
    )


def _drop_standstill(rows: Rows, *, threshold: float, test: str) -> Rows:
    """A quasistatic test without the samples at rest or without voltage."""
    left = rows.select((np.abs(rows.voltage) > 0) & (np.abs(rows.velocity) >= threshold))
    if not len(left):
        raise NotIdentifiable(
            f"{test} never moves: no sample has a voltage and a speed above {threshold:.3g}, the "
            "noise floor",
            advice="Check that the encoder is read, the motor was enabled, and the test ran until "
            "the mechanism moved.",
        )
    return left


def _differentiate(rows: Rows, *, median: int, test: str) -> Rows:
    """Rows with a median-filtered velocity and its central difference over the mean period.

    SysId divides by the mean period of the test, not by that of each sample. Its first value is
    half of the true slope, and its last one zero.
    """
    if len(rows) < max(3, median):
        raise NotIdentifiable(
            f"{test} has {len(rows)} samples in motion, too few for an acceleration",
            advice="Let the mechanism move longer, or log faster.",
        )
    velocity = rows.velocity if median == 1 else median_filter(rows.velocity, window=median)
    counted = rows.period[rows.period < LONGEST_GAP]
    if not counted.size:
        raise NotIdentifiable(
            f"the moving samples of {test} are all more than {LONGEST_GAP} s apart",
            advice="Log every loop of the robot program, 20 ms or faster.",
        )
    span = 2.0 * float(np.mean(counted))
    acceleration = np.empty_like(velocity)
    acceleration[0] = (velocity[1] - velocity[0]) / span
    acceleration[1:-1] = (velocity[2:] - velocity[:-2]) / span
    acceleration[-1] = 0.0
    return Rows(rows.time, rows.period, rows.voltage, rows.position, velocity, acceleration)


def _drop_zero_acceleration(rows: Rows, *, test: str) -> Rows:
    """Rows without those whose acceleration is exactly zero, which SysId treats as missing."""
    left = rows.select(rows.acceleration != 0.0)
    if not len(left):
        raise NotIdentifiable(
            f"the velocity of {test} never changes",
            advice="Check that the velocity is read from the encoder on every loop.",
        )
    return left
