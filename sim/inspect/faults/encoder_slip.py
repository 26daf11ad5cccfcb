"""Encoder slip: the sensor slips on its shaft for a short time.

On a robot: a set screw, a magnet, a belt or a coupling slips under load and grips again. The motion
itself is unchanged. Position and velocity both read too little of it, or the coupling skips a tooth
and both jump.

Effect on the gains: the same voltage seems to give less speed, and the speed to change instantly.
kA and kV become too large, kS far too small (a slip of 30 % from mid-run on: kV +71 %, kA more than
fivefold), while the simulated velocity R² is still 0.9.

Fingerprint: the velocity falls by a share of itself from one sample to the next and returns as
suddenly, which is impossible for a mass.
"""

from collections.abc import Iterable

import numpy as np

from sim.core.log import Log
from sim.inspect.anomalies import SLACK, Anomaly
from sim.inspect.fault import (
    Damage,
    DamagedLog,
    Fault,
    FaultStrike,
    LogInterval,
    replace_run,
    rescale_motion,
)
from sim.inspect.log_features import LogFeatures

SLIP = 0.4  # [s] length of a slip, or half of the rest of the run
HOP = 0.08  # [s] length of a skipped tooth, at least four samples
SKIPS = 0.25  # [share] of slips that are skipped teeth
LOSS = 0.7  # [1] the sensor reads exp(-LOSS·severity) of the speed: one half at severity 1
SKIP = 1.3  # [times the speed] that a skipped tooth at severity 1 subtracts or adds
BRIEF = 0.15  # [s] longest anomaly that grows and fades and is still a slip
BELIEVED = 0.92  # [share explained] least of a slip
FEWEST = 3  # [samples] fewer are a wild reading
MOST = 2.0  # [s] longest slip: longer is a wrong scale
BACK = 2  # [samples] with right readings before the run ends


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Reduce or shift the sensor's readings for a short time."""
    run = log.runs[strike.run]
    start = float(run.time[0]) + strike.start
    left = float(run.time[-1]) - start
    if rng.random() < SKIPS:
        period = float(np.median(np.diff(run.time)))
        lasts = max(HOP, 4.0 * period)
        pace = 1.0 - float(rng.choice((-1.0, 1.0))) * SKIP * strike.severity
    else:
        lasts, pace = min(SLIP, left / 2.0), float(np.exp(-LOSS * strike.severity))
    slips = (run.time > start) & (run.time <= start + lasts)
    if not np.any(run.velocity[slips]):
        return DamagedLog(log, ())
    spoilt = rescale_motion(run, np.where(slips, pace, 1.0))
    where = LogInterval(strike.run, run.test, start, min(start + lasts, float(run.time[-1])))
    return DamagedLog(replace_run(log, strike.run, spoilt), (where,))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find intervals in which the velocity is abruptly off by a fixed share, then right again."""
    for anomaly in features.anomalies:
        share, loss, first, last = _fit_slip(anomaly, features.period)
        run = features.log.runs[anomaly.run]
        back = anomaly.begin + last <= len(run) - BACK
        start, end = (float(run.time[anomaly.begin + i]) for i in (first, last - 1))
        if share < BELIEVED or not back or end - start > MOST:
            continue
        evidence, advice = _describe_slip(
            abs(loss), low=loss > 0, samples=last - first, lasts=end - start
        )
        yield Damage(
            where=LogInterval(anomaly.run, run.test, start, end),
            confidence=share,
            evidence=evidence,
            advice=advice,
        )


def _describe_slip(loss: float, *, low: bool, samples: int, lasts: float) -> tuple[str, str]:
    """Evidence and advice about a slip, or about single wrong readings."""
    off = f"{loss:.0%} too {'low' if low else 'high'}"
    if samples < FEWEST:
        some, window = ("a single sample", 3) if samples == 1 else (f"{samples} samples", 5)
        return (
            (
                f"For {some}, the velocity in the log is {off}; the samples before and after are "
                "right. This is a wild reading of the sensor, not a slip."
            ),
            (
                f"Leave this reading out, or fit by SysId's method with a median of {window}. If "
                "it happens often, check the sensor and its cable."
            ),
        )
    return (
        (
            f"From one sample to the next, the velocity in the log becomes {off}. After "
            f"{lasts:.2f} s it is right again. No motor changes its speed that fast, so the sensor "
            "slipped on its shaft."
        ),
        "Fix the sensor to its shaft, and run this test again. Until then, cut these seconds out.",
    )


def _fit_slip(anomaly: Anomaly, period: float) -> tuple[float, float, int, int]:
    """Share explained, share of the speed lost, first sample, and the one after the last.

    A longer anomaly that grows and fades is not a slip: its share is 0.
    """
    sudden, gradual = (
        _search_spans(anomaly, fading=fading, margin=max(3, round(SLACK / period)))
        for fading in (False, True)
    )
    if gradual[0] <= sudden[0]:
        return sudden
    brief = (gradual[3] - gradual[2]) * period <= BRIEF
    return gradual if brief else (0.0, *sudden[1:])


def _search_spans(anomaly: Anomaly, *, fading: bool, margin: int) -> tuple[float, float, int, int]:
    """The best result of ``_fit_speed_loss`` over all candidate spans of an anomaly."""
    best = (0.0, 0.0, 0, 1)
    for span in anomaly.list_candidate_spans(margin=margin):
        best = max(best, _fit_speed_loss(anomaly, span, fading=fading))
    for span in anomaly.refine_spans(best[2:], margin=margin):
        best = max(best, _fit_speed_loss(anomaly, span, fading=fading))
    return best


def _fit_speed_loss(
    anomaly: Anomaly, span: tuple[int, int], *, fading: bool
) -> tuple[float, float, int, int]:
    """Fit a loss of speed: explained share of the anomaly, loss [share of the speed], samples.

    ``fading`` is a loss that grows and fades; otherwise it is constant over the span.
    """
    first, last = span
    shape = np.zeros(anomaly.residual.size)
    shape[first:last] = anomaly.expected[first:last]
    if fading:
        shape[first:last] *= np.hanning(last - first + 2)[1:-1]
    size = float(shape @ shape)
    loss = -float(shape @ anomaly.residual) / size if size > 0.0 else 0.0
    return (anomaly.compute_explained_share(-loss * shape), loss, first, last)


FAULT = Fault(
    name="encoder-slip",
    summary="the sensor slips on its shaft, or skips a tooth",
    ordinary="the sensor shows half of the speed for 0.4 s, or skips for 0.08 s",
    spoil=spoil,
    detect=detect,
)
