"""Step response of the fitted mechanism under its motor controller, simulated.

    volts = feedforward + kP·(target - measured) - kD·(change of measured)/period,  at most ±12 V

The controller looks once each period, at what its sensor says of a moment ago, and holds its
voltage until it looks again. Between its looks the mechanism moves by the exact solution of

    V = kS·sgn(v) + kV·v + kA·a + gravity

and where friction is stronger than everything else, it stands. The derivative is taken of the
measurement, so the jump itself is no kick. Plain numbers: `sysid fit` need not wait for an engine.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from sim.core.errors import BadRequest
from sim.feedback.regulator import PRESETS, Feedback, Preset

BATTERY = 12.0  # [V] the most a controller can ask for
FINE = 1e-3  # [s] between two points of the motion, at most
SIZES = {"velocity": 0.5, "position": 0.1}  # of the free speed; [s] at it: a step worth looking at
SHORTEST, LONGEST = 1.0, 5.0  # [s] that is watched
TIMESCALES, WAITS, LOOKS = 6.0, 30.0, 50.0  # and between these, what is slowest that many times
FARTHEST = 1e6  # [steps] a loop that has run away so far is not watched any longer


@dataclass(frozen=True)
class Plant:
    """The controlled mechanism: its gains, per any one unit of position.

    Args:
        type: ``simple``, ``elevator`` or ``arm``.
        gains: kS [V], kV [V·s/unit], kA [V·s²/unit], kG [V] where there is gravity, offset_rad.
        angle: [rad] in one unit of position, of an arm.
    """

    type: str
    gains: Mapping[str, float]
    angle: float = 1.0

    def compute_gravity_voltage(self, position: float) -> float:
        """[V] gravity voltage at a position."""
        held = self.gains.get("kG", 0.0)
        if self.type != "arm":
            return held
        return held * math.cos(position * self.angle + self.gains.get("offset_rad", 0.0))

    @property
    def level_position(self) -> float:
        """[unit] where an arm is horizontal, which is where it is heaviest; zero of all others."""
        return -self.gains.get("offset_rad", 0.0) / self.angle if self.type == "arm" else 0.0

    def choose_target_step(self, loop: str) -> float:
        """[unit/s or unit] a sensible step of the target, rounded to one digit.

        Half of the free speed, or the way it goes in a tenth of a second at all of it: far enough
        to see, and not so far that the battery decides alone. nan if 12 V cannot move it.

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
        target: [unit/s or unit] by how much the target jumped at time 0.
        time: (n,) [s].
        value: (n,) [unit/s or unit] the velocity, or the way since time 0.
        voltage: (n,) [V] applied.
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
    """Simulate a loop whose target jumps while the mechanism is at rest.

    The feedforward is that of the gains: for a velocity all of it, for a position only what gravity
    takes, because a target that stands asks for no speed. An arm begins where it is horizontal.

    Args:
        plant: what is controlled.
        loop: ``velocity`` or ``position``.
        feedback: gains in the output units of the preset.
        target: [unit/s or unit] by how much it jumps.
        preset: the motor controller that closes the loop.
        delay: [s] of the measurement; None takes the preset's.
        seconds: [s] how long to watch; None chooses by what is slowest.

    Raises:
        BadRequest: an unknown loop, or numbers that nothing can be simulated with.

    Examples:
        >>> plant = Plant("simple", {"kS": 0.1, "kV": 2.5, "kA": 0.4})
        >>> own = Feedback(2.0, 0.0)
        >>> took = simulate_step_response(plant, loop="velocity", feedback=own, target=2.0)
        >>> round(took.value[-1], 2)  # [m/s]
        2.0
    """
    wait = preset.delay if delay is None else max(0.0, delay)
    _check(plant, loop=loop, numbers=(feedback.kp, feedback.kd, target, wait))
    points = max(1, math.ceil(preset.period / FINE - 1e-9))
    moving = MovingPlant(plant, step=preset.period / points)
    controller = _Controller(plant, loop, feedback, preset, target=target)
    seen = moving.path if loop == "position" else moving.speed
    first, behind, voltage = seen[0], wait / moving.step, [0.0]
    for _ in range(math.ceil((seconds or _watched(plant, wait, preset)) / preset.period)):
        volts = controller.volts(_past(seen, behind), position=moving.path[-1])
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
        plant: what moves.
        step: [s].
        start: [unit] where it begins; None where its weight is largest.
        speed: [unit/s] at which it begins.
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
        """Advance by one step under a voltage."""
        x, v = self.path[-1], self.speed[-1]
        free, ks = volts - self.plant.compute_gravity_voltage(x), self.plant.gains["kS"]
        after = 0.0
        if v != 0.0 or abs(free) > ks:
            way = math.copysign(1.0, v or free)
            after = self.keep * v + self.gain * (free - way * ks)
            if after * way < 0.0:  # friction stops it; whether it stays, the next step decides
                after = 0.0
        self.speed.append(after)
        self.path.append(x + 0.5 * self.step * (v + after))


class _Controller:
    """A motor controller's arithmetic, its output turned into volts."""

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
        """What it applies until it looks again."""
        change = 0.0 if self.last is None else measured - self.last
        self.last = measured
        asked = self._forward(position) + self.kp * (self.target - measured) - self.kd * change
        return min(max(asked, -BATTERY), BATTERY)

    def _forward(self, position: float) -> float:
        if self.loop == "position":
            return self.plant.compute_gravity_voltage(self.target)
        gains = self.plant.gains
        friction = math.copysign(gains["kS"], self.target) if self.target else 0.0
        return friction + gains["kV"] * self.target + self.plant.compute_gravity_voltage(position)


def _past(values: Sequence[float], behind: float) -> float:
    """The value so many points ago; the first one stands for all before it."""
    place = len(values) - 1 - behind
    if place <= 0.0:
        return values[0]
    early = int(place)
    share = place - early
    return values[early] + (share * (values[early + 1] - values[early]) if share else 0.0)


def _watched(plant: Plant, wait: float, preset: Preset) -> float:
    """[s] long enough for what is slowest to show."""
    kv, ka = plant.gains["kV"], plant.gains["kA"]
    slow = max(TIMESCALES * ka / kv if kv else LONGEST, WAITS * wait, LOOKS * preset.period)
    return min(max(slow, SHORTEST), LONGEST)


def _check(plant: Plant, *, loop: str, numbers: tuple[float, ...]) -> None:
    if loop not in SIZES:
        raise BadRequest(f"unknown loop {loop!r}", advice=f"Choose one of: {', '.join(SIZES)}.")
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
