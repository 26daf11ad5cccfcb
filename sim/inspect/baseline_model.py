"""Robust regression of kS, kV, kA and gravity, which one damaged part of a log does not spoil.

    ∫V dt = kV·∫v dt + kA·Δv + kS·∫sgn v dt + ∫(k0 + kc·cos x + ks·sin x) dt

over windows of a tenth of a second. No acceleration is needed, which keeps the noise small. The
last term is gravity of any type of mechanism. Outlying rows get less weight. These gains are only
accurate enough to make anomalies visible.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.core.log import Array, Run

WINDOW = 0.1  # [s] a row of the regression; at least three samples
ROWS = 150  # per run, at most
START, FADES = 0.6, 0.15  # [s] after a voltage step that determine kA, and decay of their weight
LARGEST_LOSS = 0.5  # [V] larger residuals count as this one
STEP = 0.5  # [share of the largest voltage] a change this large within two samples is a step
ROUNDS, HUBER_ROUNDS = 8, 3  # reweightings in all, and the first ones, with Huber's weights
TUNING = 4.685  # [robust deviations] where Tukey's weight reaches zero
FEWEST = 12  # [rows] fewer do not determine the six coefficients
RIDGE = 1e-4  # [share of the mean square] regularizes terms that a short travel cannot separate
FASTEST, SLOWEST = 0.004, 5.0  # [s] limits of kA/kV


@dataclass(frozen=True, eq=False)
class BaselineModel:
    """Gains that describe most of a log, without its outliers.

    Args:
        kv: [V·s/m or V·s/rad] positive.
        ka: [V·s²/m or V·s²/rad] positive.
        ks: [V] not negative.
        gravity_terms: (3,) [V] coefficients of 1, cos x and sin x.
    """

    kv: float
    ka: float
    ks: float
    gravity_terms: Array

    def compute_steady_speed(self, voltage: Array, position: Array) -> Array:
        """(n,) [m/s or rad/s] steady-state velocity under each voltage (n,) at a position (n,)."""
        pull = voltage - self.compute_gravity(position)
        return np.asarray(np.sign(pull) * np.maximum(np.abs(pull) - self.ks, 0.0) / self.kv)

    def replay(self, run: Run, *, voltage: Array, first: int, last: int, velocity: float) -> Array:
        """Simulate the velocity under a voltage, with friction and gravity.

        Args:
            run: the run whose times and positions are used.
            voltage: (n,) [V] in place of the run's voltage.
            first: index of the first sample.
            last: index after the last sample.
            velocity: [m/s or rad/s] at the first sample.

        Returns:
            (last - first,) [m/s or rad/s] the velocities.
        """
        part = slice(first, last)
        pull = (voltage[part] - self.compute_gravity(run.position[part])) / self.kv
        keep = np.exp(-np.diff(run.time[part]) / self.timescale)
        hold, speed = self.ks / self.kv, float(velocity)
        speeds = [speed]
        for want, share in zip(pull.tolist(), keep.tolist(), strict=False):
            if speed == 0.0 and abs(want) <= hold:
                speeds.append(0.0)
                continue
            way = (want > 0.0) - (want < 0.0) if speed == 0.0 else (speed > 0.0) - (speed < 0.0)
            toward = want - way * hold
            speed = toward + (speed - toward) * share
            if speed * way < 0.0:
                speed = 0.0  # friction holds it until the next sample
            speeds.append(speed)
        return np.array(speeds[: max(last - first, 0)])

    @property
    def timescale(self) -> float:
        """[s] time constant kA/kV."""
        return self.ka / self.kv

    def compute_gravity(self, position: Array) -> Array:
        """(n,) [V] gravity voltage at positions (n,) [m or rad]."""
        k0, kc, ks = self.gravity_terms
        return np.asarray(k0 + kc * np.cos(position) + ks * np.sin(position))


def fit_baseline(runs: Sequence[Run], *, still: float, period: float) -> BaselineModel | None:
    """Fit kS, kV, kA and gravity robustly, by iteratively reweighted least squares.

    Args:
        runs: the runs of a log.
        still: [m/s or rad/s] a slower mechanism is at rest.
        period: [s] usual time between samples.

    Returns:
        The model; None if there is too little motion, or if kV or kA is not positive, as with
        opposed signs.
    """
    parts = [_make_rows(run, still=still, period=period) for run in runs]
    rows = np.concatenate([part for part in parts if part.size] or [np.zeros((0, 8))])
    part = np.repeat(np.arange(len(parts)), [len(one) for one in parts])
    if len(rows) < FEWEST:
        return None
    volts, terms, start = rows[:, 0], rows[:, 1:7], rows[:, 7]
    scale = np.maximum(np.sqrt(np.mean(terms**2, axis=0)), 1e-300)
    gains = _regress_robustly(terms / scale, volts) / scale
    for _ in range(2):  # kA from the starts of steps alone, then the other gains
        gains[1] = _fit_acceleration(
            volts - np.delete(terms, 1, 1) @ np.delete(gains, 1), terms, start, part
        )
        if not np.isfinite(gains[1]):
            return None
        rest = np.delete(terms / scale, 1, 1)
        others = _regress_robustly(rest, volts - gains[1] * terms[:, 1])
        gains = np.insert(others / np.delete(scale, 1), 1, gains[1])
    kv, ka = float(gains[0]), float(gains[1])
    if not (kv > 0.0 and ka > 0.0):
        return None
    ka = float(np.clip(ka, FASTEST * kv, SLOWEST * kv))
    return BaselineModel(kv, ka, max(float(gains[2]), 0.0), gains[3:])


def _make_rows(run: Run, *, still: float, period: float) -> Array:
    """(m, 8): mean voltage, the six regressors, and the weight of a row for kA."""
    wide = max(3, round(WINDOW / period)) if period > 0.0 else 3
    last = len(run) - wide
    if last < 1:
        return np.zeros((0, 8))
    first = np.arange(0, last, max(1, last // ROWS))
    span = run.time[first + wide] - run.time[first]
    dt = np.diff(run.time)

    def mean(held: Array) -> Array:
        total = np.concatenate(([0.0], np.cumsum(held * dt)))
        return np.asarray((total[first + wide] - total[first]) / span)

    middle = (run.velocity[1:] + run.velocity[:-1]) / 2.0
    place = (run.position[1:] + run.position[:-1]) / 2.0
    speed = np.abs(run.velocity)
    way = np.sign(run.velocity) * (speed > still)
    total = np.concatenate(([0.0], np.cumsum(way)))
    constant = np.abs(total[first + wide + 1] - total[first]) > wide  # direction does not change
    rows = np.stack(
        (
            mean(run.voltage[:-1]),
            mean(middle),
            (run.velocity[first + wide] - run.velocity[first]) / span,
            np.sign(mean(middle)),
            np.ones(first.size),
            mean(np.cos(place)),
            mean(np.sin(place)),
            _find_samples_after_step(run)[first],
        ),
        axis=1,
    )
    begins = rows[:, 7] > 0.0
    keep = constant | (begins & (np.abs(rows[:, 1]) > still))
    return np.asarray(rows[keep])


def _find_samples_after_step(run: Run) -> Array:
    """(n,) weight of a sample for kA: 1 just after a voltage step, decaying to 0."""
    size = float(np.max(np.abs(run.voltage), initial=0.0))
    jump = np.abs(run.voltage - np.concatenate(([0.0, 0.0], run.voltage[:-2])))[: len(run)]
    at = np.flatnonzero(jump > STEP * size) if size > 0.0 else np.zeros(0, dtype=np.intp)
    after = np.zeros(len(run))
    if at.size:
        latest = np.searchsorted(at, np.arange(len(run)), side="right") - 1
        ago = run.time - run.time[at[np.maximum(latest, 0)]]
        soon = (latest >= 0) & (ago < START)
        after[soon] = np.exp(-ago[soon] / FADES)
    return after


def _fit_acceleration(left: Array, terms: Array, start: Array, part: NDArray[np.int_]) -> float:
    """Robust kA [V·s²/unit] from rows after a voltage step.

    Each run gives a weighted median; the result is that with the smallest loss over all rows.
    """
    change = terms[:, 1]
    driven = (np.sign(change) == np.sign(terms[:, 0])) & (change != 0.0)
    if np.any(driven & (start > 0.0)):
        driven &= start > 0.0
    else:
        start = np.ones(start.size)
    left, change, start, part = left[driven], change[driven], start[driven], part[driven]
    candidates = [
        _compute_weighted_median(left[mine] / change[mine], np.abs(change[mine]) * start[mine])
        for mine in (part == one for one in np.unique(part))
    ]
    return min(
        candidates,
        key=lambda ka: float(start @ np.minimum(np.abs(left - ka * change), LARGEST_LOSS)),
        default=float("nan"),
    )


def _compute_weighted_median(values: Array, weights: Array) -> float:
    """The median of values (n,) with weights (n,)."""
    order = np.argsort(values)
    share = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(share, 0.5 * share[-1])])


def _regress_robustly(terms: Array, volts: Array) -> Array:
    """(k,) least-squares coefficients, iteratively reweighted (Huber, then Tukey's biweight)."""
    weight: Array = np.ones(volts.size)
    ridge = RIDGE * np.eye(terms.shape[1])
    gains: Array = np.zeros(terms.shape[1])
    for turn in range(ROUNDS):
        weighted = terms * weight[:, None]
        normal = weighted.T @ terms + ridge * max(float(weight.sum()), 1e-300)
        gains = np.asarray(np.linalg.solve(normal, weighted.T @ volts))
        left = np.abs(volts - terms @ gains)
        spread = float(np.median(left)) / 0.6745
        if spread <= 0.0:
            break
        near = left / (TUNING * spread)
        if turn < HUBER_ROUNDS:
            weight = np.asarray(1.0 / np.maximum(left / spread, 1.0))
        else:
            weight = np.asarray(np.square(np.maximum(1.0 - near**2, 0.0)))
    return gains
