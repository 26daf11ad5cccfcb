"""Command logged: the log holds the commanded voltage, not the applied one.

On a robot: the program logs its own command. A current limit reduces the motor's voltage while the
mechanism starts, or the battery voltage sags, and the log shows neither.

Effect on the gains: a step that starts slowly looks like a heavy mechanism. A 7 V step under a 120
A limit and a sagging battery gives a kA that is 51 % too large if the commanded voltage is logged,
with an acceleration R² of 0.96, and 1 % if the applied voltage is logged.

Fingerprint: the voltage is a perfect step, and the mechanism starts with a constant acceleration
instead of its largest one, until the back-EMF has brought the current under the limit.

    v' = min(V - kV·v, limit)/kA - …    a straight line at first, then the usual exponential

A battery that only sags cannot be recognized in a log of four tests: with a constant duty cycle,
the sag has the same effect as a heavier load. So this fault is a clipped current.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import Log, Run
from sim.inspect.fault import (
    Damage,
    DamagedLog,
    Fault,
    FaultStrike,
    LogInterval,
    damage_runs,
    rescale_motion,
)
from sim.inspect.log_features import LogFeatures, find_driven_samples
from sim.inspect.step_rise import StepRise, find_rise, simulate_wheels

KEEPS = (
    1.0 / 3.0
)  # [share] of the acceleration at the start at severity 1; its exponent is the cube
# root of the severity, because a start with more than half of its acceleration shows no fault
FINE = 10  # simulation steps per sample
PERFECT = 0.002  # [share of the step] largest deviation of a commanded voltage
ROUNDING = 0.0051  # [V] the same, for voltages written with two digits

FEWEST = 8  # [samples] of a start that is evaluated
BENT = 0.0012  # [share of speed times time constant] RMS error of a start without a limit, at least
FLAT = 0.8  # [share of the step] largest current limit that is plausible
TRUE = 1.25  # [1] largest factor between the speed and that of the baseline model
BETTER = 0.3  # [share] of its squared error that a limit leaves, at most


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:  # noqa: ARG001 - the contract
    """Limit the current at the start of each dynamic test, but log the commanded voltage."""
    features, damaged = LogFeatures(log), {}
    for index, run in enumerate(features.log.runs):
        if run.kind == log.runs[strike.run].kind:
            spoilt = _clip_voltage(features, index, keeps=float(KEEPS ** np.cbrt(strike.severity)))
            if spoilt is not None:
                damaged[index] = spoilt
    return damage_runs(log, damaged)


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find exact voltage steps under which the mechanism starts too slowly.

    A limit acts in both directions: if only one of several steps starts slowly, the cause is
    another.
    """
    if features.baseline is None:
        return []
    rises = {
        index: find_rise(run, features.baseline, period=features.period, summed=True)
        for index, run in enumerate(features.log.runs)
        if run.kind == "dynamic" and _is_exact_step(run)
    }
    found = [
        _detect_limit(index, features.log.runs[index], rise)
        for index, rise in rises.items()
        if rise
    ]
    damages = [damage for damage in found if damage]
    return damages if len(damages) >= min(len(found), 2) else []


def _detect_limit(index: int, run: Run, rise: StepRise) -> Damage | None:
    """The damage if a current limit explains a start; else None."""
    free = rise.fit()
    if free.error < BENT * rise.step * rise.scale:
        return None
    held = rise.fit("current", np.linspace(0.1, 1.0, 10))
    left = (held.error / free.error) ** 2
    if left >= BETTER or held.share > FLAT or not 1.0 / TRUE < held.size < TRUE:
        return None
    volts = float(np.median(run.voltage))
    return Damage(
        where=LogInterval.of_samples(index, run),
        confidence=1.0 - left,
        evidence=f"The log shows exactly {volts:.3g} V, but at first the mechanism has only "
        f"{held.share:.0%} of the acceleration that this voltage gives later. A current limit "
        "reduced the voltage, and the log contains the commanded one.",
        advice="Log the applied voltage, which the motor controller measures, or use a step "
        f"smaller than {abs(volts):.1f} V. Until then, do not trust kA.",
    )


def _clip_voltage(features: LogFeatures, index: int, *, keeps: float) -> Run | None:
    """The run with ``keeps`` [share] of its acceleration at the start; None if it has no step."""
    run, baseline = features.log.runs[index], features.baseline
    driven = find_driven_samples(run)
    if baseline is None or driven.size < FEWEST:
        return None
    first, last = int(driven[0]), int(driven[-1]) + 1
    volts = float(np.median(run.voltage[first:last]))
    way, since = np.sign(volts), run.time[first:] - run.time[first]
    fine = np.linspace(0.0, since[-1], FINE * since.size)
    speeds = []
    for asked, keep in ((run.voltage, np.inf), (np.full(len(run), volts), keeps)):
        push = way * baseline.compute_steady_speed(asked, run.position)[first:]
        spin = simulate_wheels(
            np.interp(fine, since, push),
            fine,
            scales=np.array([baseline.timescale]),
            grips=np.array([np.inf]),
            limits=np.array([keep * push[0]]),
        )
        speeds.append(np.interp(since, fine, spin.speed[0]))
    free, held = speeds  # the first is perhaps limited as well
    moves = free > features.still_speed
    pace = np.ones(len(run))
    pace[first:][moves] = np.clip(held[moves] / free[moves], 0.0, 1.0)
    voltage = run.voltage.copy()
    voltage[first:last] = volts
    spoilt = replace(rescale_motion(run, pace), voltage=voltage)
    if run.current is None:
        return spoilt
    most = keeps * float(np.abs(run.current).max())
    return replace(spoilt, current=np.clip(run.current, -most, most))


def _is_exact_step(run: Run) -> bool:
    """Whether the voltage is that of a command: the same from the first sample to the last."""
    driven = find_driven_samples(run)
    if driven.size < FEWEST:
        return False
    inside = run.voltage[driven[0] : driven[-1] + 1]
    asked = float(np.median(inside))
    deviation = float(np.abs(inside - asked).max())
    return deviation <= max(PERFECT * abs(asked), ROUNDING)


FAULT = Fault(
    name="command-logged",
    summary="the log contains the commanded voltage, but a current limit reduced it",
    ordinary="a step starts with 33 % of its acceleration",
    spoil=spoil,
    detect=detect,
    kinds=("dynamic",),
    whole=True,
)
