"""Simulated step response of the fitted mechanism under feedback of its motor controller.

    volts = feedforward + kP·(target - measured) - kD·(change of measured)/period,  at most ±12 V

The controller samples its delayed measurement once each period, and holds its voltage until the
next sample. In between, the mechanism moves by the exact solution of

    V = kS·sgn(v) + kV·v + kA·a + gravity

and stands still while friction is larger than the driving voltage. The derivative is that of the
measurement, so the step of the target causes no derivative kick. The code uses plain Python, so
that `sysid fit` does not load the simulation engine.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from sim.core.errors import BadRequest, refuse_unknown
from sim.core.units import BATTERY
from sim.feedback.regulator import PRESETS, Feedback, Preset

FINE = 1e-3  # [s] largest time step of the simulation
SIZES = {"velocity": 0.5, "position": 0.1}  # step as share of the free speed, or as time at it [s]
SHORTEST, LONGEST = 1.0, 5.0  # [s] limits of the simulated time
# Simulated time: the longest of so many time constants, delays and periods.
TIMESCALES, DELAYS, PERIODS = 6.0, 30.0, 50.0
FARTHEST = 1e6  # [steps] at a larger value, the simulation of an unstable loop ends


@dataclass(frozen=True)
class Plant:
    """The controlled mechanism: its gains, per any one unit of position.

    Args:
        type: ``simple``, ``elevator`` or ``arm``.
        gains: kS [V], kV [V·s/unit], kA [V·s²/unit], with gravity kG [V], for an arm offset_rad
            [rad].
        angle: angle of one unit of position, for an arm [rad].
    """

    type: str
    gains: Mapping[str, float]
    angle: float = 1.0

    def compute_gravity_voltage(self, position: float) -> float:
        """The voltage [V] that holds the mechanism against gravity at a position [unit]."""
        held = self.gains.get("kG", 0.0)
        if self.type != "arm":
            return held
        return held * math.cos(position * self.angle + self.gains.get("offset_rad", 0.0))

    @property
    def level_position(self) -> float:
        """The position [unit] at which an arm is horizontal, with the largest gravity; else 0."""
        return -self.gains.get("offset_rad", 0.0) / self.angle if self.type == "arm" else 0.0

    def choose_target_step(self, loop: str) -> float:
        """A reasonable step of the target [unit/s or unit], rounded to one digit.

        Half of the free speed, or the distance in 0.1 s at free speed: large enough to be visible,
        and small enough that the voltage does not saturate for long. nan if 12 V cannot move it.

        Args:
            loop: ``velocity`` or ``position``.
        """
        kv, taken = self.gains["kV"], self.gains["kS"] + abs(self.gains.get("kG", 0.0))
        if not (kv > 0.0 and taken < BATTERY):
            return math.nan
        return float(f"{SIZES[loop] * (BATTERY - taken) / kv:.0e}")


@dataclass(frozen=True, eq=False)
class StepResponse:
    """The simulated response to a step of the target.

    Args:
        loop: ``velocity`` or ``position``.
        target: step of the target at time 0 [unit/s or unit].
        time: (n,) [s].
        value: (n,) velocity [unit/s], or position relative to time 0 [unit].
        voltage: (n,) applied voltage [V].
    """

    loop: str
    target: float
    time: tuple[float, ...]
    value: tuple[float, ...]
    voltage: tuple[float, ...]


def simulate_step_response(
    plant: Plant,
    *,
    loop: str,
    feedback: Feedback,
    target: float,
    preset: Preset = PRESETS["default"],
    delay: float | None = None,
    seconds: float | None = None,
) -> StepResponse:
    """Simulate the response of a loop to a step of the target, from rest.

    A velocity loop has the full feedforward of the gains, a position loop only that of gravity,
    because the target does not move. An arm begins where it is horizontal.

    Args:
        plant: the controlled mechanism.
        loop: ``velocity`` or ``position``.
        feedback: gains in the output units of the preset.
        target: step of the target [unit/s or unit].
        preset: the motor controller that closes the loop.
        delay: delay of the measurement [s]; None takes the preset's.
        seconds: simulated time [s]; None chooses it by the slowest time constant.

    Raises:
        BadRequest: the loop is unknown, a number is not finite, kS or kV is negative, or kA is not
            positive.

    Examples:
        >>> plant = Plant("simple", {"kS": 0.1, "kV": 2.5, "kA": 0.4})
        >>> own = Feedback(2.0, 0.0)
        >>> took = simulate_step_response(plant, loop="velocity", feedback=own, target=2.0)
        >>> round(took.value[-1], 2)  # [m/s]
        2.0
    """
    wait = preset.delay if delay is None else max(0.0, delay)
    _refuse_bad_numbers(plant, loop=loop, numbers=(feedback.kp, feedback.kd, target, wait))
    points = max(1, math.ceil(preset.period / FINE - 1e-9))
    moving = MovingPlant(plant, step=preset.period / points)
    controller = _Controller(plant, loop, feedback, preset, target=target)
    seen = moving.path if loop == "position" else moving.speed
    first, behind, voltage = seen[0], wait / moving.step, [0.0]
    for _ in range(math.ceil((seconds or _choose_duration(plant, wait, preset)) / preset.period)):
        volts = controller.volts(_get_delayed_value(seen, behind), position=moving.path[-1])
        for _ in range(points):
            moving.apply_voltage(volts)
        voltage += [volts] * points
        if abs(seen[-1] - first) > FARTHEST * abs(target):
            break
    time = tuple(moving.step * k for k in range(len(seen)))
    return StepResponse(loop, target, time, tuple(v - first for v in seen), tuple(voltage))


class MovingPlant:
    """The state of a simulated mechanism, advanced in equal steps.

    Args:
        plant: the mechanism.
        step: time step [s].
        start: initial position [unit]; None takes the one with the largest gravity.
        speed: initial velocity [unit/s].
    """

    def __init__(
        self, plant: Plant, *, step: float, start: float | None = None, speed: float = 0.0
    ) -> None:
        kv, ka = plant.gains["kV"], plant.gains["kA"]
        self.plant, self.step = plant, step
        self.keep = math.exp(-kv / ka * step)
        self.gain = -math.expm1(-kv / ka * step) / kv if kv else step / ka
        self.path, self.speed = [plant.level_position if start is None else start], [speed]

    def apply_voltage(self, volts: float) -> None:
        """Advance by one step under a voltage [V]."""
        x, v = self.path[-1], self.speed[-1]
        free, ks = volts - self.plant.compute_gravity_voltage(x), self.plant.gains["kS"]
        after = 0.0
        if v != 0.0 or abs(free) > ks:
            way = math.copysign(1.0, v or free)
            after = self.keep * v + self.gain * (free - way * ks)
            if after * way < 0.0:  # friction stops it; the next step decides whether it stays
                after = 0.0
        self.speed.append(after)
        self.path.append(x + 0.5 * self.step * (v + after))


class _Controller:
    """The control law of a motor controller, with its output in volts."""

    def __init__(
        self, plant: Plant, loop: str, feedback: Feedback, preset: Preset, *, target: float
    ) -> None:
        counts = preset.velocity_time if loop == "velocity" else 1.0
        self.kp = feedback.kp * counts / preset.output
        per_loop = preset.period if not preset.normalized else 1.0
        self.kd = feedback.kd * counts * per_loop / preset.output / preset.period
        self.plant, self.loop = plant, loop
        self.target = target + (plant.level_position if loop == "position" else 0.0)
        self.last: float | None = None

    def volts(self, measured: float, *, position: float) -> float:
        """The voltage [V] that it applies until its next sample."""
        change = 0.0 if self.last is None else measured - self.last
        self.last = measured
        asked = (
            self._compute_feedforward(position)
            + self.kp * (self.target - measured)
            - self.kd * change
        )
        return min(max(asked, -BATTERY), BATTERY)

    def _compute_feedforward(self, position: float) -> float:
        if self.loop == "position":
            return self.plant.compute_gravity_voltage(self.target)
        gains = self.plant.gains
        friction = math.copysign(gains["kS"], self.target) if self.target else 0.0
        return friction + gains["kV"] * self.target + self.plant.compute_gravity_voltage(position)


def _get_delayed_value(values: Sequence[float], behind: float) -> float:
    """The interpolated value ``behind`` points ago; before the first point, the first value."""
    place = len(values) - 1 - behind
    if place <= 0.0:
        return values[0]
    early = int(place)
    share = place - early
    return values[early] + (share * (values[early + 1] - values[early]) if share else 0.0)


def _choose_duration(plant: Plant, wait: float, preset: Preset) -> float:
    """The simulated time [s], by the slowest of time constant, delay and period."""
    kv, ka = plant.gains["kV"], plant.gains["kA"]
    slow = max(TIMESCALES * ka / kv if kv else LONGEST, DELAYS * wait, PERIODS * preset.period)
    return min(max(slow, SHORTEST), LONGEST)


def _refuse_bad_numbers(plant: Plant, *, loop: str, numbers: tuple[float, ...]) -> None:
    refuse_unknown("loop", loop, SIZES)
    if not all(map(math.isfinite, (*numbers, *plant.gains.values()))):
        raise BadRequest(
            "a gain or a target of this loop is not a number", advice="Give finite numbers."
        )
    gains = plant.gains
    if not (gains["kV"] >= 0.0 and gains["kA"] > 0.0 and gains["kS"] >= 0.0):
        raise BadRequest(
            f"no loop can be simulated with kS = {gains['kS']:.4g}, kV = {gains['kV']:.4g}, "
            f"kA = {gains['kA']:.4g}",
            advice="First find out why the fit gives a negative gain.",
        )
