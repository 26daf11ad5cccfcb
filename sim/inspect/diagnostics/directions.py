"""Compare forward and reverse: whether one kS and one kV describe both."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.log import DIRECTIONS, Array, Run
from sim.core.units import find_unit
from sim.inspect.log_features import MIN_SAMPLES, LogFeatures

APART_KS = 0.12, 0.35  # [V, share of their mean] largest normal difference of kS
APART_KV = 0.05  # [share] largest normal difference of kV
SETTLED, SMOOTH = 3.0, 0.1  # [time constants] of a ramp left out; [s] half width of a slope
SIGMAS = 5.0  # [standard errors] of a significant difference


@dataclass(frozen=True)
class _Line:
    """KS [V] and kV [V·s/m or V·s/rad] of one direction, with their standard errors."""

    ks: float
    kv: float
    ks_error: float
    kv_error: float


def check_directions(features: LogFeatures) -> Iterator[Doubt]:
    """Doubts about forward and reverse ramps that need different voltages for one speed."""
    forward, reverse = (_fit_direction(features, way) for way in DIRECTIONS)
    if forward is None or reverse is None:
        return
    ks, kv = 0.5 * (forward.ks + reverse.ks), 0.5 * (forward.kv + reverse.kv)
    apart = abs(forward.ks - reverse.ks)
    noise = SIGMAS * float(np.hypot(forward.ks_error, reverse.ks_error))
    simple = features.log.type not in ("elevator", "arm")
    if simple and apart > max(APART_KS[0], APART_KS[1] * abs(ks), noise):
        yield Doubt(
            "friction-differs",
            f"It needs {forward.ks:.2f} V to start moving forward but {reverse.ks:.2f} V in "
            "reverse. Friction differs between the directions, or the type of mechanism "
            "leaves out a weight. One kS cannot describe both, and the error ends up in kA.",
            action=Action("rubs-or-type"),
        )
    apart, per = abs(forward.kv - reverse.kv), find_unit(features.log.units)
    noise = SIGMAS * float(np.hypot(forward.kv_error, reverse.kv_error))
    if apart > max(APART_KV * kv, noise):
        yield Doubt(
            "back-emf-differs",
            f"Forward takes {forward.kv * per.si:.3g} V per {per.symbol}/s, reverse "
            f"{reverse.kv * per.si:.3g}: they differ by {apart / kv:.0%}. The load "
            "differs between the directions, or the sensor reads one direction differently. "
            "Plot voltage against velocity, and trust kV only to this difference.",
        )


def _fit_direction(features: LogFeatures, way: str) -> _Line | None:
    """The line of voltage over velocity of a direction's first ramp; None if there is none.

    Noise of the velocity, a column of this fit, would make kV too small. So the voltage beyond
    gravity, which that noise does not reach, is the fit's instrument.
    """
    runs = [i for i, run in enumerate(features.log.runs) if run.test == f"quasistatic-{way}"]
    if not runs or features.baseline is None:
        return None
    run, baseline = features.log.runs[runs[0]], features.baseline
    if len(run) < MIN_SAMPLES:
        return None
    sign = 1.0 if way == "forward" else -1.0
    fast = run.moving & (sign * run.velocity > features.still_speed)
    begins = run.time[int(np.argmax(fast))] + SETTLED * baseline.timescale
    fast &= (run.time > begins) & (run.time < run.time[-1] - SMOOTH)
    if fast.sum() < 3 * MIN_SAMPLES:
        return None
    load = np.zeros(len(run))
    if features.log.type in ("elevator", "arm"):
        load = baseline.compute_gravity(run.position)
    push = sign * (run.voltage - load)
    volts = (push - sign * baseline.ka * _compute_acceleration(run, features.period))[fast]
    speed = np.abs(run.velocity[fast])
    known = push[fast] - push[fast].mean()
    shared = float(known @ speed)
    if not np.ptp(speed) or shared <= 0.0:  # a sensor may be so coarse that it has one speed only
        return None
    kv = float(known @ volts) / shared
    ks = float(volts.mean() - kv * speed.mean())
    scatter = float(np.std(volts - ks - kv * speed, ddof=2))
    kv_error = scatter * float(np.linalg.norm(known)) / shared
    ks_error = float(np.hypot(scatter / np.sqrt(len(speed)), speed.mean() * kv_error))
    return _Line(ks, kv, ks_error, kv_error)


def _compute_acceleration(run: Run, period: float) -> Array:
    """(n,) [m/s² or rad/s²] slope of the velocity over ``SMOOTH`` to both sides."""
    reach = max(1, round(SMOOTH / period))
    late = np.minimum(np.arange(len(run)) + reach, len(run) - 1)
    early = np.maximum(np.arange(len(run)) - reach, 0)
    slope = (run.velocity[late] - run.velocity[early]) / (run.time[late] - run.time[early])
    return np.asarray(slope)
