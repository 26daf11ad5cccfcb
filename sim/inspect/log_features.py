"""Features of a log that detectors use, each computed once, on demand.

All of them are robust: one damaged part of a log hardly changes them.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Log, Run, find_majority_sign, integrate_velocity
from sim.estimation.measurements import compute_noise_deviation
from sim.inspect.anomalies import Anomaly, find_anomalies, predict_velocity
from sim.inspect.baseline_model import BaselineModel, fit_baseline
from sim.physics.velocity_lag import VelocityLag, estimate_velocity_lag

STANDING = 0.03  # [share of the log's top speed] slower samples are at rest
MIN_SAMPLES = 10  # of a run that is evaluated, or damaged
FEWEST = 6  # [samples] of voltage that tell a ramp from a step
RAMP, STEP = 0.55, 0.7  # median voltage of the first half over that of the second: 1/3 in a ramp
DRIVEN = 0.05  # [share of a run's largest voltage] less is before or after the test
STEPS, CREEP = 1.5, 2e-5  # [smallest steps of the position, share of its way] a position at rest
PARTS = 10  # of a run's motion, evaluated one by one: a slip or a stop changes one or two of them
COPIED = 0.01  # [share of the variance] largest residual of a velocity that copies the position
TINY = 1e-12  # [1] smallest scale, for its logarithm
LEAST = 3  # samples in a part, and parts of a motion
FAR = 0.1  # [share of the longest part's distance] shorter parts are left out
Flags: TypeAlias = NDArray[np.bool_]
Counts: TypeAlias = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class LogFeatures:
    """Features of a log.

    Args:
        log: the log.
    """

    log: Log

    @cached_property
    def period(self) -> float:
        """[s] median time between two samples of a run; nan if no run has two."""
        steps = [np.diff(run.time) for run in self.log.runs if len(run) > 1]
        return float(np.median(np.concatenate(steps))) if steps else float("nan")

    @cached_property
    def position_step(self) -> float:
        """[m or rad] the smallest change of a position in the log; inf if none ever changes."""
        return _find_smallest_step([run.position for run in self.log.runs])

    @cached_property
    def velocity_step(self) -> float:
        """[m/s or rad/s] the smallest change of a velocity in the log; inf if none changes."""
        return _find_smallest_step([run.velocity for run in self.log.runs])

    @cached_property
    def recognized_tests(self) -> tuple[str, ...]:
        """Per run, the test recognized from its voltage and motion, like ``quasistatic-forward``.

        The direction is that of the test's name if voltage and motion disagree, and a test that is
        neither a ramp nor a step keeps its name.
        """
        return tuple(_recognize_test(run) for run in self.log.runs)

    @cached_property
    def rest_lengths(self) -> tuple[int, ...]:
        """Per run, number of samples before its position first changes; 0 if it never does."""
        return tuple(_measure_rest_length(run, step=self.position_step) for run in self.log.runs)

    @cached_property
    def distance_ratios(self) -> tuple[float, ...]:
        """Per run, [1] the integral of its velocity divided by the change of its position.

        1 if a run moves too little.
        """
        return tuple(_measure_distance_ratio(run) for run in self.log.runs)

    @cached_property
    def usual_distance_ratio(self) -> float:
        """[1] median of the distance ratios: a wrong conversion factor is the same in all runs."""
        return float(np.median(self.distance_ratios)) if self.distance_ratios else 1.0

    @cached_property
    def velocity_lag(self) -> VelocityLag | None:
        """Delay and scale of velocity against position; None if nothing moves."""
        return estimate_velocity_lag(self.log.runs)

    @cached_property
    def position_copy_factors(self) -> tuple[float, ...]:
        """Per run, [1/s] factor by which its velocity copies its position; 0 if it does not."""
        return tuple(_copy_factor(run) for run in self.log.runs)

    @cached_property
    def noise(self) -> float:
        """[m/s or rad/s] velocity noise in motion, estimated without a model.

        From third differences of new readings, which are almost zero for a smooth motion.
        """
        thirds = []
        for run in self.log.runs:
            new = run.velocity[find_held_samples(run.velocity)[0]] if len(run) else run.velocity
            third = np.diff(new, n=3)
            thirds.append(third[np.abs(new[3:]) > STANDING * run.top_speed])
        return compute_noise_deviation(thirds)

    @cached_property
    def still_speed(self) -> float:
        """[m/s or rad/s] threshold between motion and standstill."""
        return STANDING * self.log.top_speed + 3.0 * self.noise

    @cached_property
    def baseline(self) -> BaselineModel | None:
        """The robustly fitted baseline model; None if the log does not determine one."""
        if np.count_nonzero(self.position_copy_factors) > len(self.position_copy_factors) / 2:
            return None
        return fit_baseline(self.log.runs, still=self.still_speed, period=self.period)

    @cached_property
    def predicted_velocities(self) -> tuple[Array, ...]:
        """Per run, (n,) [m/s or rad/s] velocity predicted by the baseline model; () without one."""
        if self.baseline is None:
            return ()
        return tuple(
            predict_velocity(run, self.baseline, still=self.still_speed)
            if len(run)
            else np.zeros(0)
            for run in self.log.runs
        )

    @cached_property
    def anomalies(self) -> tuple[Anomaly, ...]:
        """Intervals in which runs do not follow the baseline model, in the order of time."""
        if self.baseline is None:
            return ()
        return find_anomalies(
            self.log.runs,
            self.predicted_velocities,
            self.baseline,
            still=self.still_speed,
            noise=self.noise,
            period=self.period,
        )


def find_held_samples(values: Array) -> tuple[Counts, Counts]:
    """Intervals in which a signal repeats one value.

    Args:
        values: (n,) the signal.

    Returns:
        (m,) index of the first sample of each interval, and (m,) their lengths in samples.
    """
    starts = np.flatnonzero(np.concatenate(([True], np.diff(values) != 0.0))[: values.size])
    return starts, np.diff(np.append(starts, values.size))


def find_driven_samples(run: Run) -> Counts:
    """Indices of the samples at which a run has a voltage, without those before and after it."""
    size = np.abs(run.voltage)
    return np.flatnonzero(size > DRIVEN * size.max(initial=0.0))


def _recognize_test(run: Run) -> str:
    """The test recognized from voltage and motion; see ``LogFeatures.recognized_tests``."""
    if run.kind not in ("quasistatic", "dynamic"):
        return run.test
    size, driven = np.abs(run.voltage), find_driven_samples(run)
    if driven.size < FEWEST:
        return run.test
    first, last = np.array_split(driven, 2)  # without the samples at rest before and after
    rise = float(np.median(size[first]) / (np.median(size[last]) or 1.0))
    kind = run.kind
    if rise < RAMP:
        kind = "quasistatic"
    elif rise > STEP:
        kind = "dynamic"
    moving = last[run.moving[last]]
    pushed, moved = find_majority_sign(run.voltage[last]), find_majority_sign(run.velocity[moving])
    if pushed * moved <= 0:
        return f"{kind}-{run.direction}"
    return f"{kind}-{'forward' if pushed > 0 else 'reverse'}"


def _measure_rest_length(run: Run, *, step: float) -> int:
    """Number of samples before the position leaves its first value."""
    band = max(STEPS * step, CREEP * float(np.ptp(run.position))) if len(run) else 0.0
    away = np.abs(run.position - run.position[:1]) > band
    return int(np.argmax(away)) if away.any() else 0


def _measure_distance_ratio(run: Run) -> float:
    """[1] integral of velocity over change of position, the median of parts of the motion."""
    motion = np.flatnonzero(run.moving)
    parts = min(PARTS, motion.size // LEAST)
    if parts < LEAST:
        return 1.0
    ends = np.linspace(motion[0], motion[-1], parts + 1).astype(int)
    summed = np.diff(integrate_velocity(run.time, run.velocity)[ends])
    changed = np.diff(run.position[ends])
    far = np.abs(changed) > FAR * np.abs(changed).max()
    if far.sum() < parts // 2:
        return 1.0
    usual = float(np.median(np.abs(summed[far] / changed[far])))
    # long frames change single parts
    whole = float(np.abs(summed[far]).sum() / np.abs(changed[far]).sum())
    return min(usual, whole, key=lambda scale: abs(np.log(max(scale, TINY))))


def _copy_factor(run: Run) -> float:
    """[1/s] factor by which the velocity is a copy of the position; 0 if it is not."""
    if not run.moving.any():
        return 0.0
    place, speed = run.position - run.position.mean(), run.velocity - run.velocity.mean()
    along, total = float(place @ speed), float(speed @ speed)
    factor = along / max(float(place @ place), TINY)
    left = 1.0 - factor * along / total if total > 0.0 else 1.0
    return factor if left < COPIED else 0.0


def _find_smallest_step(signals: list[Array]) -> float:
    """The smallest change between two samples of any signal; inf if none changes."""
    steps = np.concatenate([np.zeros(0), *(np.abs(np.diff(values)) for values in signals)])
    return float(np.min(steps, where=steps > 0.0, initial=np.inf))
