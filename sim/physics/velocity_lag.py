"""The delay of the recorded velocity against the recorded position.

A motor controller averages its velocity, so the velocity of a sample is often older than its
position. Differentiating the position to compare them amplifies its quantization; integrating the
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

from sim.core.log import Array, Run, integrate_velocity
from sim.core.units import ROBUST

EARLIEST, LATEST = -0.05, 0.4  # [s] range of the delays; the slowest published filter is 0.11
STEP = 0.005  # [s] grid of the delays, which the parabola refines
WINDOW, MIN_STEPS = 0.3, 8  # [s, samples] of an integral: many frames, and a part of a run
MAX_SAMPLES = 1000  # times of a run that are compared; more do not add information
MIN_SAMPLES = 20  # [samples] of a run; fewer do not determine scale, delay and start
EXACT = 1e-9  # [share of the variance] a smaller residual is rounding
MATCHED = 0.02  # [share of the variance] larger residuals are of two different motions


@dataclass(frozen=True)
class VelocityLag:
    """Delay and scale of a log's velocity against its position.

    Args:
        lag: [s] delay of the velocity behind the position; negative if it is earlier.
        error: [s] one standard error, from the scatter of the runs; nan if there is one run only.
        scale: [1] velocity divided by the slope of the position; the median of the runs.
        unexplained: [share of the variance] residual of the integrals.
    """

    lag: float
    error: float
    scale: float
    unexplained: float

    @property
    def matched(self) -> bool:
        """Whether velocity and position show the same motion, so that the delay is meaningful."""
        return self.unexplained <= MATCHED


def estimate_velocity_lag(runs: Sequence[Run]) -> VelocityLag | None:
    """Estimate the delay of velocity against position by matching integrals.

    Args:
        runs: runs of one log, recorded by the same device; those that do not move are left out.

    Returns:
        Delay and scale, or None if no run moves. The delay is meaningful only if ``matched``.
    """
    lags = np.arange(EARLIEST, LATEST + STEP / 2.0, STEP)
    fits = [fit for run in runs if (fit := _fit_run(run, lags)) is not None]
    if not fits:
        return None
    likelihood = sum(-0.5 * count * np.log(share + EXACT) for share, _, count in fits)
    best = int(np.argmax(likelihood))
    unexplained = float(np.median([share[best] for share, _, _ in fits]))
    scale = float(np.median([scales[best] for _, scales, _ in fits]))
    lag = _find_parabola_maximum(lags, np.asarray(likelihood), best)
    deviations = [
        abs(_find_parabola_maximum(lags, -np.log(share + EXACT), int(share.argmin())) - lag)
        for share, _, _ in fits
    ]
    several = len(deviations) > 1
    spread = ROBUST * float(np.median(deviations)) if several else np.nan
    error = spread / np.sqrt(len(deviations)) if several else np.nan
    return VelocityLag(lag, float(error), scale, unexplained)


def _fit_run(run: Run, lags: Array) -> tuple[Array, Array, int] | None:
    """For each delay of (lags,), the unexplained share and the scale; and the number of samples."""
    if len(run) < MIN_SAMPLES or not run.top_speed > 0.0 or not np.ptp(run.position) > 0.0:
        return None
    integral = integrate_velocity(run.time, run.velocity)
    # before a start at rest the position is known
    first = run.time[0] + LATEST if run.moving[0] else run.time[0]
    inside = np.flatnonzero((run.time >= first) & (run.time <= run.time[-1] + EARLIEST))
    if inside.size < MIN_SAMPLES:
        return None
    times = run.time[inside]
    if times.size > MAX_SAMPLES:  # every n-th sample could always be the same one of a frame
        times = np.linspace(times[0], times[-1], MAX_SAMPLES)
    window = max(WINDOW, MIN_STEPS * float(np.median(np.diff(run.time))))

    def change(signal: Array, until: Array) -> Array:
        end = np.interp(until, run.time, signal)
        return np.asarray(end - np.interp(until - window, run.time, signal))

    summed = change(integral, times)
    total = float(summed @ summed)
    if not total > 0.0:
        return None
    delayed = change(run.position, times - lags[:, None])
    product, size = delayed @ summed, np.einsum("ij,ij->i", delayed, delayed)
    slope = product / np.maximum(size, np.finfo(float).tiny)
    return np.maximum(1.0 - slope * product / total, 0.0), slope, int(times.size)


def _find_parabola_maximum(lags: Array, likelihood: Array, best: int) -> float:
    """[s] the maximum of the parabola through the best delay and its two neighbors."""
    if not 0 < best < lags.size - 1:
        return float(lags[best])
    before, top, after = (float(likelihood[best + k]) for k in (-1, 0, 1))
    bend = before - 2.0 * top + after
    shift = 0.5 * (before - after) / bend if bend < 0.0 else 0.0
    return float(lags[best] + STEP * np.clip(shift, -0.5, 0.5))
