"""Sign flip: voltage, position and velocity do not have the same positive direction.

On a robot: a motor is inverted and its encoder is not, the voltage is logged without its sign, or
velocity and position are from different sensors.

Effect on the gains: if every run is flipped, kS, kV and kA are negative with the right size, and R²
is as good as before. If only some runs are flipped, all gains are nonsense.

Fingerprint: at a high voltage the mechanism moves against the voltage, and faster at a higher one;
or the velocity has the sign opposite to the slope of the position. Gravity can also move a
mechanism against a voltage, but then it is slower at a higher one.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from sim.core.log import Array, Log, Run, find_majority_sign
from sim.core.units import Unit, find_unit
from sim.inspect.fault import Damage, DamagedLog, Fault, FaultStrike, LogInterval, damage_runs
from sim.inspect.log_features import Flags, LogFeatures

ONE_WAY, BOTH_WAYS = 0.7, 2.0  # [severity] from which on all tests of a direction, or all, flip
HARD = 0.5  # [share of the largest voltage] less may be below gravity and friction
FEWEST = 5  # [samples] at a high voltage and in motion, at least
FALLS = 3.0  # [1] ratio of the speeds of both directions from which on gravity is the cause


def spoil(log: Log, strike: FaultStrike, rng: np.random.Generator) -> DamagedLog:
    """Reverse the sign of a signal: in one run, in the runs of one direction, or in all."""
    signals = (("voltage",), ("position", "velocity"), ("velocity",))[int(rng.integers(3))]
    struck = log.runs[strike.run]
    damaged = {}
    for index, run in enumerate(log.runs):
        alike = run.direction == struck.direction and strike.severity >= ONE_WAY
        if index == strike.run or alike or strike.severity >= BOTH_WAYS:
            flipped = {name: -getattr(run, name) for name in signals}
            damaged[index] = replace(run, **flipped)
    return damage_runs(log, damaged)


def detect(features: LogFeatures) -> Iterable[Damage]:
    """Compare the signs of voltage, velocity and the slope of position in every run."""
    for index, run in enumerate(features.log.runs):
        if features.position_copy_factors[index]:  # such a velocity has no sign
            continue
        moving = run.moving
        slope = np.gradient(run.position, run.time) if len(run) > 1 else np.zeros(len(run))
        against_slope = _have_opposite_signs(run.velocity, slope, moving & _find_large(slope))
        against_voltage = _moves_against_voltage(run, run.velocity, moving)
        if against_voltage and not against_slope and _falls_by_gravity(run, features.log):
            continue
        said = []
        if against_voltage:
            said.append("the voltage and the velocity have opposite signs")
        if against_slope:
            said.append("the velocity has the sign opposite to the slope of the position")
        if said:
            unit = find_unit(features.log.units)
            yield _describe_damage(index, run, said, unit, velocity_only=against_slope)


def _find_large(values: Array) -> Flags:
    """(n,) whether a value is more than ``HARD`` of the largest ones."""
    size = np.abs(values)
    return np.asarray(size > HARD * np.percentile(size, 98)) if size.size else size > 0.0


def _have_opposite_signs(one: Array, other: Array, judged: Flags) -> bool:
    """Whether most of the judged samples (n,) of two signals have opposite signs."""
    return bool(judged.sum() >= FEWEST) and find_majority_sign(one[judged] * other[judged]) < 0


def _moves_against_voltage(run: Run, velocity: Array, moving: Flags) -> bool:
    """Whether it moves against the voltage, and in a ramp faster at a higher voltage."""
    judged = moving & _find_large(run.voltage)
    if not _have_opposite_signs(run.voltage, velocity, judged):
        return False
    if run.kind != "quasistatic":
        return True
    volts, speed = run.voltage[judged], velocity[judged]
    return float((volts - volts.mean()) @ (speed - speed.mean())) <= 0.0


def _falls_by_gravity(run: Run, log: Log) -> bool:
    """Whether the other direction of the test moves the same way, several times as fast."""
    mate = f"{run.kind}-{'reverse' if run.direction == 'forward' else 'forward'}"
    for other in log.list_runs_of_test(mate):
        goes = find_majority_sign(other.velocity) * find_majority_sign(run.velocity) > 0
        if goes and other.top_speed > FALLS * run.top_speed:
            return True
    return False


def _describe_damage(
    index: int, run: Run, said: list[str], unit: Unit, *, velocity_only: bool
) -> Damage:
    """The damage of a run; ``said`` are the observations."""
    volts, speed = _compute_median_of_large(run.voltage), _compute_median_of_large(run.velocity)
    cure = (
        "Give velocity the sign of the position's slope"
        if velocity_only
        else (
            "Invert the motor or the encoder, so that a positive voltage gives a positive velocity"
        )
    )
    return Damage(
        where=LogInterval.of_samples(index, run),
        confidence=0.95,
        evidence=f"{' and '.join(said).capitalize()}: at {volts:.3g} V the velocity is "
        f"{speed / unit.si:.3g} {unit.symbol}/s, while the position changes by "
        f"{(run.position[-1] - run.position[0]) / unit.si:.3g} {unit.symbol}.",
        advice=f"{cure}, and log the voltage with its sign. Then record again, or change the "
        "sign in the log.",
    )


def _compute_median_of_large(values: Array) -> float:
    """The median of the larger half of the values; 0 if there are none."""
    hard = values[_find_large(values)]
    return float(np.median(hard)) if hard.size else 0.0


FAULT = Fault(
    name="sign-flip",
    summary="voltage, position and velocity do not have the same positive direction",
    ordinary="one signal has the wrong sign in one direction; at severity 2 in both",
    spoil=spoil,
    detect=detect,
    whole=True,
)
