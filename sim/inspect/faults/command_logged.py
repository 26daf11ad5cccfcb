"""Command logged: the log holds the commanded voltage, not the applied one.

On a robot: the program logs its own request. A current limit clips what the motor gets while the
mechanism starts, or the battery sags under it, and the log knows nothing of either.

To the gains: a step that started gently is taken for a heavy mechanism. A 7 V step under a 120 A
limit and a sagging battery, logged as asked for, gives kA 51 % too large with an acceleration R²
of 0.96; logged as applied, 1 %.

Fingerprint: the voltage is a perfect step, and the mechanism starts at a constant acceleration
where it should start at its largest, until its own speed has brought the current under the limit.

    v' = min(V - kV·v, limit)/kA - …    a straight line at first, then the usual exponential

A battery that merely sags leaves no mark of its own in a log of four tests: with a constant duty
cycle the sag grows with the current just as a heavier load would. Hence the fault strikes, and is
sought, where the current is clipped.
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

KEEPS = 1.0 / 3.0  # [share] of its acceleration that a start keeps at severity 1; by the cube
# root of the severity, because what costs less than half of the acceleration leaves no mark
FINE = 10  # steps of the model to a sample
PERFECT = 0.002  # [share of the step] within which a voltage is a command and no measurement
ROUNDING = 0.0051  # [V] the same, for voltages written with two digits

FEWEST = 8  # [samples] of the start; fewer cannot show its shape
MOST = 60  # [steps] a longer start is looked at more coarsely
WIDE = 6.0  # [timescales] that are looked at
LONGEST = 3.0  # [s]
SMOOTH = 20  # steps of the model to a timescale
FINER = (1.0, 0.5, 0.2, 0.07)  # [share of the coarse grid's cells] the grids after it
LATEST = 0.08  # [s] after the voltage a sensor may still be silent
BENT = 0.0012  # [share of a timescale's way, RMS] by which a start without a limit must miss
BETTER = 0.3  # [share] of its squared error that may be left with one
FLAT = 0.2  # [share] of the acceleration that must be lacking at first
TRUE = 1.25  # [times] the baseline model's own speed is still the one it was found with


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

    A limit knows no direction: where only one of several steps starts like that, it had an accident
    of its own.
    """
    found, judged = [], 0
    for index, run in enumerate(features.log.runs):
        first = _step(run) if run.kind == "dynamic" else None
        start = None if first is None else _start(features, index, first)
        if start is None:
            continue
        judged += 1
        damage = _limited(index, run, start)
        if damage is not None:
            found.append(damage)
    return found if len(found) >= min(judged, 2) else []


def _limited(index: int, run: Run, start: "_Start") -> Damage | None:
    """What a limit explains of a start, if it does."""
    free = _search(start, lacks=np.zeros(1))
    if free.error < BENT * start.length:
        return None
    held = _search(start, lacks=np.linspace(0.0, 0.9, 10))
    left = (held.error / free.error) ** 2
    believed = held.lacks > FLAT and 1.0 / TRUE < held.scale < TRUE
    return _damage(index, run, held, left=left) if believed and left < BETTER else None


@dataclass(frozen=True, eq=False)
class _Start:
    """How a step test starts, counted in its own direction.

    Args:
        time: (n,) [s] since the voltage.
        way: (n,) [m or rad] about their mean: positions, which no filter bends.
        volts: [V] of the step.
        steady: (m,) [V] that friction and gravity take, at every ``step`` [s].
        step: [s]
        baseline: what the rest of the log says.
    """

    time: Array
    way: Array
    volts: float
    steady: Array
    step: float
    baseline: BaselineModel

    @property
    def length(self) -> float:
        """[m or rad] how far the step's own speed would take it in one timescale."""
        return (
            (self.volts - float(np.median(self.steady)))
            / self.baseline.kv
            * (self.baseline.timescale)
        )


@dataclass(frozen=True)
class _Shape:
    """A start described.

    Args:
        error: [m or rad] root of the mean square.
        scale: [times] the speed that the baseline model predicts.
        ka: [V·s²/m or V·s²/rad].
        lacks: [share] of the acceleration at first.
        delay: [s] before it moves.
    """

    error: float
    scale: float
    ka: float
    lacks: float
    delay: float


def _clipped(features: LogFeatures, index: int, *, keeps: float) -> Run | None:
    """The run with a start that keeps a share of its acceleration; None if it has no step."""
    run, baseline = features.log.runs[index], features.baseline
    driven = np.flatnonzero(np.abs(run.voltage) > DRIVEN * np.abs(run.voltage).max(initial=0.0))
    if baseline is None or driven.size < FEWEST:
        return None
    first, last = int(driven[0]), int(driven[-1]) + 1
    asked = float(np.median(run.voltage[first:last]))
    since = run.time[first:] - run.time[first]
    place, asks = float(run.position[first]), np.full(since.size, asked)
    free = _rise(since, run.voltage[first:], place, baseline, keeps=1.0)  # clipped, too, perhaps
    held = _rise(since, asks, place, baseline, keeps=keeps)
    moves = free > features.still_speed
    pace = np.ones(len(run))
    pace[first:][moves] = np.clip(held[moves] / free[moves], 0.0, 1.0)
    voltage = run.voltage.copy()
    voltage[first:last] = asked
    spoilt = replace(rescale_motion(run, pace), voltage=voltage)
    if run.current is None:
        return spoilt
    most = keeps * float(np.abs(run.current).max())
    return replace(spoilt, current=np.clip(run.current, -most, most))


def _rise(
    since: Array, voltage: Array, place: float, baseline: BaselineModel, *, keeps: float
) -> Array:
    """(n,) [m/s or rad/s] from rest at a place, in the direction of the voltage (n,) [V]."""
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
    """Where a perfect step of voltage begins; None if the voltage is no such thing."""
    size = np.abs(run.voltage)
    driven = np.flatnonzero(size > DRIVEN * size.max(initial=0.0))
    if driven.size < FEWEST:
        return None
    inside = run.voltage[driven[0] : driven[-1] + 1]
    asked = float(np.median(inside))
    stray = float(np.abs(inside - asked).max())
    return int(driven[0]) if stray <= max(PERFECT * abs(asked), ROUNDING) else None


def _start(features: LogFeatures, index: int, first: int) -> _Start | None:
    """The part of a test that tells how it starts."""
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
    """The shape that fits best: on a coarse grid, then on finer ones around its best point."""
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
    ka, lack = (grid.ravel() for grid in np.meshgrid(kas, lacks, indexing="ij"))
    ways = _ways(start, ka, lack)
    best = _Shape(np.inf, 1.0, float(ka[0]), 0.0, 0.0)
    for delay in delays.tolist():
        at = np.clip((start.time - delay) / start.step, 0.0, len(ways) - 1.001)
        low = at.astype(int)
        gone = ways[low] + (at - low)[:, None] * (ways[low + 1] - ways[low])
        gone -= gone.mean(axis=0)
        along = start.way @ gone
        scale = along / np.maximum(np.einsum("ij,ij->j", gone, gone), 1e-300)
        errors = np.maximum(start.way @ start.way - scale * along, 1e-300)
        i = int(np.argmin(errors))
        error = float(np.sqrt(errors[i] / start.way.size))
        if error < best.error:
            best = _Shape(error, float(scale[i]), float(ka[i]), float(lack[i]), delay)
    return best


def _ways(start: _Start, ka: Array, lack: Array) -> Array:
    """(steps, shapes) [m or rad] how far the model has gone, for many kA and limits at once."""
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
