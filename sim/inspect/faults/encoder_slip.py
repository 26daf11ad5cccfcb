"""Encoder slip: the sensor loses its grip on the shaft for a while.

On a robot: a set screw, a magnet, a belt or a coupling that lets go under load and grips again. The
motion itself is unharmed; position and velocity both read too little of it, or the coupling skips a
tooth and both hop.

To the gains: the same voltage seems to bring less speed, and speed to come and go in no time. kA
and kV are too large, kS far too small (a slip of 30 % from mid-run on: kV +71 %, kA more than
fivefold), while the simulated velocity still fits at R² 0.9.

Fingerprint: the velocity falls by a share of itself from one sample to the next and comes back as
suddenly, which no voltage can do to a mass.
"""

from collections.abc import Iterable

import numpy as np

from sim.core.log import Array, Log
from sim.inspect.anomalies import Anomaly
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

SLIP = 0.4  # [s] as long as a slip lasts, or half of what is left of the run
HOP = 0.08  # [s] as long as a skipped tooth takes, at least four samples
SKIPS = 0.25  # [share] of slips that are skipped teeth
LOSS = 0.7  # reads exp(-LOSS·severity) of the speed: one half at severity 1
SKIP = 1.3  # [times the speed] that a tooth skipped at severity 1 takes off or adds
SLACK = 0.06  # [s] how exactly an anomaly shows where it begins and ends
BRIEF = 0.15  # [s] a longer anomaly that swells and fades is no slip
LEAST = 0.15  # [share of the speed] a smaller loss is not told from an effect
SURE = 0.97  # the same at the start of a run, and of a few samples, where less proves nothing
FEWEST = 3  # [samples]
MOST = 2.0  # [s] what lasts longer is no slip but a wrong scale
BACK = 2  # [samples] that read right again before the run ends
BELIEVED = 0.92  # [share explained] less is something else
AT_END = 0.005  # [share of the travel] within which it stands, at the end of it


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Reduce or shift the sensor's readings for a moment."""
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
        if anomaly.recurs:
            continue
        share, loss, first, last = _best(anomaly, features.period)
        run = features.log.runs[anomaly.run]
        back = anomaly.begin + last <= len(run) - BACK
        proof = SURE if anomaly.at_start or last - first < FEWEST else BELIEVED
        start, end = (float(run.time[anomaly.begin + i]) for i in (first, last - 1))
        if share < proof or abs(loss) < LEAST or not back or end - start > MOST:
            continue
        if _stands_at_its_end(features, run.position[anomaly.begin + first : anomaly.begin + last]):
            continue
        evidence, advice = _explain(
            abs(loss), low=loss > 0, samples=last - first, lasts=end - start
        )
        yield Damage(
            fault="encoder-slip",
            where=LogInterval(anomaly.run, run.test, start, end),
            confidence=share,
            evidence=evidence,
            advice=advice,
        )


def _explain(loss: float, *, low: bool, samples: int, lasts: float) -> tuple[str, str]:
    """Evidence and advice: of a slip, or of single wild readings, which move no shaft."""
    off = f"{loss:.0%} too {'low' if low else 'high'}"
    if samples < FEWEST:
        some, window = ("a single sample", 3) if samples == 1 else (f"{samples} samples", 5)
        return (
            (
                f"For {some}, the velocity in the log is {off}; the samples before and after are "
                "right. This is a wild reading of the sensor, not a slip."
            ),
            (
                f"Cut this reading out, or add --method sysid --median {window} to the fit. If it "
                "happens often, check the sensor and its cable."
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


def _stands_at_its_end(features: LogFeatures, position: Array) -> bool:
    """Whether it stands where it can go no further: steps up and down end on a stop."""
    every = np.concatenate([run.position for run in features.log.runs])
    lowest, highest = float(every.min()), float(every.max())
    near = AT_END * (highest - lowest)
    usual = float(np.median(position))
    return usual - lowest < near or highest - usual < near


def _best(anomaly: Anomaly, period: float) -> tuple[float, float, int, int]:
    """Share explained, share of the speed lost, first sample and the one behind the last.

    What swells and fades over a longer time is no slip, whatever share of it a slip explains.
    """
    sudden, swelling = (
        _over_spans(anomaly, swells=swells, margin=max(3, round(SLACK / period)))
        for swells in (False, True)
    )
    if swelling[0] <= sudden[0]:
        return sudden
    brief = (swelling[3] - swelling[2]) * period <= BRIEF
    return swelling if brief else (0.0, *sudden[1:])


def _over_spans(anomaly: Anomaly, *, swells: bool, margin: int) -> tuple[float, float, int, int]:
    """The same over all spans, for one of the two shapes."""
    best = (0.0, 0.0, 0, 1)
    for span in anomaly.list_candidate_spans(margin=margin):
        best = max(best, _loss(anomaly, span, swells=swells))
    for span in anomaly.refine_spans(best[2:], margin=margin):
        best = max(best, _loss(anomaly, span, swells=swells))
    return best


def _loss(
    anomaly: Anomaly, span: tuple[int, int], *, swells: bool
) -> tuple[float, float, int, int]:
    """The same for one span: all at once, or swelling and fading."""
    first, last = span
    shape = np.zeros(anomaly.residual.size)
    shape[first:last] = anomaly.expected[first:last]
    if swells:
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
