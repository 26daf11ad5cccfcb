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
from dataclasses import dataclass, replace

import numpy as np

from sim.core.log import Array, Log, Run
from sim.inspect.baseline_model import BaselineModel
from sim.inspect.fault import (
    Damage,
    DamagedLog,
    Fault,
    FaultStrike,
    LogInterval,
    replace_run,
    rescale_motion,
)
from sim.inspect.log_features import DRIVEN, LogFeatures

KEEPS = (
    1.0 / 3.0
)  # [share] of the acceleration at the start at severity 1; its exponent is the cube
# root of the severity, because a start with more than half of its acceleration shows no fault
FINE = 10  # simulation steps per sample
PERFECT = 0.002  # [share of the step] largest deviation of a commanded voltage
ROUNDING = 0.0051  # [V] the same, for voltages written with two digits

FEWEST = 8  # [samples] of a start that is evaluated
MOST = 60  # [samples] of a start that are used
WIDE = 6.0  # [time constants] length of the start
LONGEST = 3.0  # [s] length of the start, at most
SMOOTH = 20  # simulation steps per time constant
FINER = (1.0, 0.5, 0.2, 0.07)  # [share of the coarse grid's cells] the finer grids
LATEST = 0.08  # [s] largest delay of a sensor
BENT = 0.0012  # [share of ``length``] RMS error of a start without a limit, at least
BETTER = 0.3  # [share] of its squared error that a limit leaves, at most
FLAT = 0.2  # [share] of the acceleration that is missing at first, at least
TRUE = 1.25  # [1] largest factor between the speed and that of the baseline model


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:  # noqa: ARG001 - the contract
    """Limit the current at the start of each dynamic test, but log the commanded voltage."""
    features, where = LogFeatures(log), []
    for index, run in enumerate(features.log.runs):
        if run.kind == log.runs[strike.run].kind:
            spoilt = _clipped(features, index, keeps=float(KEEPS ** np.cbrt(strike.severity)))
            if spoilt is not None:
                log = replace_run(log, index, spoilt)
                where.append(LogInterval.of_samples(index, run))
    return DamagedLog(log, tuple(where))


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Find exact voltage steps under which the mechanism starts too slowly.

    A limit acts in both directions: if only one of several steps starts slowly, the cause is
    another.
    """
    found, judged = [], 0
    for index, run in enumerate(features.log.runs):
        first = _step(run) if run.kind == "dynamic" else None
        start = None if first is None else _start(features, index, first)
        if start is None:
            continue
        judged += 1
        damage = _detect_limit(index, run, start)
        if damage is not None:
            found.append(damage)
    return found if len(found) >= min(judged, 2) else []


def _detect_limit(index: int, run: Run, start: "_Start") -> Damage | None:
    """The damage if a current limit explains a start; else None."""
    free = _search(start, lacks=np.zeros(1))
    if free.error < BENT * start.length:
        return None
    held = _search(start, lacks=np.linspace(0.0, 0.9, 10))
    left = (held.error / free.error) ** 2
    plausible = held.lacks > FLAT and 1.0 / TRUE < held.scale < TRUE
    return _damage(index, run, held, left=left) if plausible and left < BETTER else None


@dataclass(frozen=True, eq=False)
class _Start:
    """The start of a step test; its direction is positive.

    Args:
        time: (n,) [s] since the voltage step.
        way: (n,) [m or rad] positions minus their mean; no filter delays them.
        volts: [V] voltage of the step.
        steady: (m,) [V] friction and gravity, at every ``step``.
        step: [s] simulation step.
        baseline: the baseline model of the log.
    """

    time: Array
    way: Array
    volts: float
    steady: Array
    step: float
    baseline: BaselineModel

    @property
    def length(self) -> float:
        """[m or rad] distance at the step's steady-state speed in one time constant."""
        return (
            (self.volts - float(np.median(self.steady)))
            / self.baseline.kv
            * (self.baseline.timescale)
        )


@dataclass(frozen=True)
class _Shape:
    """A fitted start.

    Args:
        error: [m or rad] RMS error of the position.
        scale: [1] speed over that of the baseline model.
        ka: [V·s²/m or V·s²/rad] kA of the start.
        lacks: [share] of the acceleration that is missing at first.
        delay: [s] before the motion.
    """

    error: float
    scale: float
    ka: float
    lacks: float
    delay: float


def _clipped(features: LogFeatures, index: int, *, keeps: float) -> Run | None:
    """The run with ``keeps`` [share] of its acceleration at the start; None if it has no step."""
    run, baseline = features.log.runs[index], features.baseline
    driven = np.flatnonzero(np.abs(run.voltage) > DRIVEN * np.abs(run.voltage).max(initial=0.0))
    if baseline is None or driven.size < FEWEST:
        return None
    first, last = int(driven[0]), int(driven[-1]) + 1
    volts = float(np.median(run.voltage[first:last]))
    since = run.time[first:] - run.time[first]
    place, command = float(run.position[first]), np.full(since.size, volts)
    free = _rise(since, run.voltage[first:], place, baseline, keeps=1.0)  # perhaps clipped as well
    held = _rise(since, command, place, baseline, keeps=keeps)
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


def _rise(
    since: Array, voltage: Array, place: float, baseline: BaselineModel, *, keeps: float
) -> Array:
    """(n,) [m/s or rad/s] speed from rest at a position, positive along the voltage (n,) [V]."""
    way = float(np.sign(np.median(voltage)))
    fine = np.linspace(0.0, since[-1], FINE * since.size)
    step, speed, speeds, most = fine[1], 0.0, [], np.inf
    for volts in (way * np.interp(fine, since, voltage)).tolist():
        speeds.append(speed)
        steady = baseline.ks + way * float(baseline.compute_gravity(np.array(place)))
        if most == np.inf and keeps < 1.0:
            most = steady + keeps * (volts - steady)
        most = max(most, steady)
        speed = max(
            speed + step * (min(volts - baseline.kv * speed, most) - steady) / baseline.ka, 0
        )
        place += way * step * speed
    return np.asarray(np.interp(since, fine, speeds))


def _step(run: Run) -> int | None:
    """Index of the first sample of an exact voltage step; None if there is none."""
    size = np.abs(run.voltage)
    driven = np.flatnonzero(size > DRIVEN * size.max(initial=0.0))
    if driven.size < FEWEST:
        return None
    inside = run.voltage[driven[0] : driven[-1] + 1]
    asked = float(np.median(inside))
    deviation = float(np.abs(inside - asked).max())
    return int(driven[0]) if deviation <= max(PERFECT * abs(asked), ROUNDING) else None


def _start(features: LogFeatures, index: int, first: int) -> _Start | None:
    """The start of a test; None without a baseline model, or with too few samples."""
    run, baseline = features.log.runs[index], features.baseline
    if baseline is None:
        return None
    lasts = min(WIDE * baseline.timescale, LONGEST)
    end = int(np.searchsorted(run.time, run.time[first] + lasts, side="right"))
    picked = slice(first, max(end, first + FEWEST + 1), max(1, (end - first) // MOST))
    time = run.time[picked] - run.time[first]
    if time.size <= FEWEST:
        return None
    way = float(np.sign(run.voltage[first]))
    step = max(baseline.timescale / SMOOTH, float(time[-1]) / (WIDE * SMOOTH))
    fine = np.arange(0.0, float(time[-1]) + 3.0 * step, step)
    place = np.interp(fine, time, run.position[picked])
    return _Start(
        time,
        way * (run.position[picked] - run.position[picked].mean()),
        abs(float(run.voltage[first])),
        baseline.ks + way * baseline.compute_gravity(place),
        step,
        baseline,
    )


def _search(start: _Start, *, lacks: Array) -> _Shape:
    """The best fit: on a coarse grid, then on finer ones around its best point."""
    period = float(np.median(np.diff(start.time)))
    kas, delays = start.baseline.ka * np.geomspace(0.15, 1.6, 24), np.linspace(-period, LATEST, 25)
    best = _best(start, kas, lacks, delays)
    for narrow in FINER:
        kas = best.ka * np.geomspace(1.0 / (1.0 + 0.2 * narrow), 1.0 + 0.2 * narrow, 9)
        delays = best.delay + (period + LATEST) / 12.0 * narrow * np.linspace(-1.0, 1.0, 9)
        if lacks.size > 1:
            lacks = np.clip(best.lacks + 0.15 * narrow * np.linspace(-1.0, 1.0, 9), 0.0, 0.95)
        better = _best(start, kas, lacks, delays)
        best = better if better.error < best.error else best
    return best


def _best(start: _Start, kas: Array, lacks: Array, delays: Array) -> _Shape:
    """The best fit on a grid of kA, missing acceleration and delay."""
    ka, lack = (grid.ravel() for grid in np.meshgrid(kas, lacks, indexing="ij"))
    ways = _ways(start, ka, lack)
    best = _Shape(np.inf, 1.0, float(ka[0]), 0.0, 0.0)
    for delay in delays.tolist():
        at = np.clip((start.time - delay) / start.step, 0.0, len(ways) - 1.001)
        low = at.astype(int)
        moved = ways[low] + (at - low)[:, None] * (ways[low + 1] - ways[low])
        moved -= moved.mean(axis=0)
        product = start.way @ moved
        scale = product / np.maximum(np.einsum("ij,ij->j", moved, moved), 1e-300)
        errors = np.maximum(start.way @ start.way - scale * product, 1e-300)
        i = int(np.argmin(errors))
        error = float(np.sqrt(errors[i] / start.way.size))
        if error < best.error:
            best = _Shape(error, float(scale[i]), float(ka[i]), float(lack[i]), delay)
    return best


def _ways(start: _Start, ka: Array, lack: Array) -> Array:
    """(steps, shapes) [m or rad] distance of the model, for many kA and limits at once."""
    kv, steady = start.baseline.kv, start.steady
    most = np.where(lack > 0.0, start.volts - lack * (start.volts - steady[0]), np.inf)
    keep = np.exp(-start.step * kv / ka)
    speed, way = np.zeros(ka.size), np.zeros(ka.size)
    ways = [way]
    for taken in steady.tolist():
        free = (start.volts - taken) / kv
        straight = speed + start.step * (most - taken) / ka
        curve = free + (speed - free) * keep
        after = np.maximum(np.where(start.volts - kv * speed > most, straight, curve), 0.0)
        way = way + 0.5 * start.step * (speed + after)
        speed = after
        ways.append(way)
    return np.array(ways)


def _damage(index: int, run: Run, shape: _Shape, *, left: float) -> Damage:
    """The damage of a run whose fit leaves a share ``left`` of the squared error."""
    return Damage(
        fault="command-logged",
        where=LogInterval.of_samples(index, run),
        confidence=1.0 - left,
        evidence=f"The log shows exactly {np.median(run.voltage):.3g} V, but at first the "
        f"mechanism has only {1.0 - shape.lacks:.0%} of the acceleration that this voltage "
        "gives later. A current limit reduced the voltage, and the log contains the "
        "commanded one.",
        advice="Log the applied voltage, which the motor controller measures, or use a step "
        f"smaller than {abs(float(np.median(run.voltage))):.1f} V. Until then, do not trust kA.",
    )


FAULT = Fault(
    name="command-logged",
    summary="the log contains the commanded voltage, but a current limit reduced it",
    ordinary="a step starts with 33 % of its acceleration",
    spoil=spoil,
    detect=detect,
    kinds=("dynamic",),
    whole=True,
)
