"""The delay of the recorded velocity against the recorded position.

A motor controller averages its velocity, so the velocity of a log is often older than the position
beside it. Differentiating the position to compare them amplifies its quantization; integrating the
velocity does not. With x the position, v the velocity and τ the delay,

    ∫v dt from t - w to t = s·(x(t - τ) - x(t - τ - w))

for every run, with a scale s of its own and a short window w, which keeps the noise of the integral
from adding up over a run. For each τ of a grid, s is found by least squares; τ is where the
likelihood of all runs is largest, refined by a parabola. Because s is free, a velocity in another
unit gives a scale, and no delay. An average over some time is found as a delay of half that time.

Method: a time delay found by matching signals over a grid of delays (Björklund, *A Survey and
Comparison of Time-Delay Estimation Methods in Linear Systems*, 2003), with the concentrated
likelihood of Gaussian errors (Ljung, *System Identification*, 1999, section 7.4).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sim.core.log import Array, Run

EARLIEST, LATEST = -0.05, 0.4  # [s] delays that are tried; the slowest published filter is 0.11
STEP = 0.005  # [s] between two of them; the parabola tells the rest
WINDOW, FEWEST_STEPS = 0.3, 8  # [s, samples] of an integral: many frames, and a part of a run
SAMPLES = 1000  # instants of a run that are compared; more tell no more
FEWEST = 20  # [samples] of a run; a line, a delay and a start cannot be told from fewer
STANDING = 0.1  # [share of the top speed] a run that begins slower than this begins at rest
EXACT = 1e-9  # [share of the variance] below it, what is left is rounding
NORMAL = 0.6745  # [standard deviations] the median distance of a normal variable from its mean
MATCHED = 0.02  # [share of the variance] that may be left unexplained by one and the same motion


@dataclass(frozen=True)
class VelocityLag:
    """Delay and scale of a log's velocity against its position.

    Args:
        lag: [s] by which the velocity is later than the position; negative if it is earlier.
        error: [s] one standard error, from how far the runs differ; nan if there is one run only.
        scale: [1] velocity over slope of the position; the median of the runs.
        unexplained: [share of the variance] of the integrals that position, lag and scale leave.
    """

    lag: float
    error: float
    scale: float
    unexplained: float

    @property
    def matched(self) -> bool:
        """Whether velocity and position show the same motion, so that the delay means anything."""
        return self.unexplained <= MATCHED


def estimate_velocity_lag(runs: Sequence[Run]) -> VelocityLag | None:
    """Estimate the delay of velocity against position by matching integrals.

    Args:
        runs: of one log, recorded by the same device; those that hardly move are left out.

    Returns:
        None if no run moves. Look at ``matched`` before believing the lag: a velocity that is not
        of this position has none.
    """
    lags = np.arange(EARLIEST, LATEST + STEP / 2.0, STEP)
    fits = [fit for run in runs if (fit := _fit_run(run, lags)) is not None]
    if not fits:
        return None
    likelihood = sum(-0.5 * count * np.log(left + EXACT) for left, _, count in fits)
    best = int(np.argmax(likelihood))
    unexplained = float(np.median([left[best] for left, _, _ in fits]))
    scale = float(np.median([scales[best] for _, scales, _ in fits]))
    lag = _refine(lags, np.asarray(likelihood), best)
    apart = [
        abs(_refine(lags, -np.log(left + EXACT), int(left.argmin())) - lag) for left, _, _ in fits
    ]
    error = float(np.median(apart)) / NORMAL / np.sqrt(len(apart)) if len(apart) > 1 else np.nan
    return VelocityLag(lag, float(error), scale, unexplained)


def _fit_run(run: Run, lags: Array) -> tuple[Array, Array, int] | None:
    """For each delay, the unexplained share and the scale; and the number of samples used."""
    if len(run) < FEWEST or not run.top_speed > 0.0 or not np.ptp(run.position) > 0.0:
        return None
    steps = 0.5 * np.diff(run.time) * (run.velocity[1:] + run.velocity[:-1])
    integral = np.concatenate(([0.0], np.cumsum(steps)))
    rests = abs(float(run.velocity[0])) < STANDING * run.top_speed
    first = run.time[0] if rests else run.time[0] + LATEST  # before a start at rest it stood
    inside = np.flatnonzero((run.time >= first) & (run.time <= run.time[-1] + EARLIEST))
    if inside.size < FEWEST:
        return None
    times = run.time[inside]
    if times.size > SAMPLES:  # not every n-th sample, which may always be the same one of a frame
        times = np.linspace(times[0], times[-1], SAMPLES)
    window = max(WINDOW, FEWEST_STEPS * float(np.median(np.diff(run.time))))

    def gone(signal: Array, until: Array) -> Array:
        late = np.interp(until, run.time, signal)
        return np.asarray(late - np.interp(until - window, run.time, signal))

    summed = gone(integral, times)
    total = float(summed @ summed)
    if not total > 0.0:
        return None
    delayed = gone(run.position, times - lags[:, None])
    along, size = delayed @ summed, np.einsum("ij,ij->i", delayed, delayed)
    slope = along / np.maximum(size, np.finfo(float).tiny)
    return np.maximum(1.0 - slope * along / total, 0.0), slope, int(times.size)


def _refine(lags: Array, likelihood: Array, best: int) -> float:
    """[s] the top of the parabola through the best delay and its two neighbors."""
    if not 0 < best < lags.size - 1:
        return float(lags[best])
    before, top, after = (float(likelihood[best + k]) for k in (-1, 0, 1))
    bend = before - 2.0 * top + after
    shift = 0.5 * (before - after) / bend if bend < 0.0 else 0.0
    return float(lags[best] + STEP * np.clip(shift, -0.5, 0.5))
