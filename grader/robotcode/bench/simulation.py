"""The mechanism that a program's motors turn, and the loop that runs both.

Each motor turns a shaft of its own by V = kS·sgn(v) + kV·v + kA·a; a follower turns with its
leader. The constants differ from motor to motor, so that their records can be told apart.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from grader.robotcode.library.base import Unknown
from grader.robotcode.library.devices import Device, Motor, Shaft
from grader.robotcode.library.world import GEARING, PERIOD, WORLD

BATTERY = 11.0  # [V] a tired one: twelfths of it are no volts
SAGGED, LIMITED = 10.5, 0.95  # [V] while something else takes current; share that gets through
MOST_LIMITS = 8  # ... of the first motor, and its powers of the next ones
GAINS = {"ks": 0.2, "kv": 0.115, "ka": 0.02}  # V, V·s/rot, V·s²/rot at the motor's shaft
STEP = {"ks": 0.03, "kv": 0.007, "ka": 0.0013}  # ... by this of each further motor
ABSOLUTE = frozenset({"CANcoder", "DutyCycleEncoder", "AnalogEncoder"})
DEEP = 6  # fields of fields that are looked into
MOST_OBJECTS = 3_000


class Load:
    """The mechanism that a shaft moves."""

    def __init__(self, number: int, shaft: Shaft) -> None:
        self.ks, self.kv, self.ka = (GAINS[name] + number * STEP[name] for name in GAINS)
        self.shaft = shaft

    def move(self, voltage: float) -> None:
        """Advance by one loop: the exact solution, except in the loop in which it comes to rest."""
        shaft, after = self.shaft, 0.0
        if shaft.velocity or abs(voltage) > self.ks:
            final = (voltage - math.copysign(self.ks, shaft.velocity or voltage)) / self.kv
            share = -math.expm1(-PERIOD * self.kv / self.ka)
            after = shaft.velocity + (final - shaft.velocity) * share
            after = 0.0 if after * shaft.velocity < 0.0 else after
        shaft.position += (shaft.velocity + after) / 2.0 * PERIOD
        shaft.velocity = after


class GearedShaft:
    """The slow shaft on which a mechanism has its absolute sensor.

    Args:
        shaft: of the motor.
    """

    def __init__(self, shaft: Shaft) -> None:
        self.shaft = shaft

    @property
    def position(self) -> float:
        """Position of the rotor [rot]."""
        return self.shaft.position / GEARING

    @property
    def velocity(self) -> float:
        """Velocity of the rotor [rot/s]."""
        return self.shaft.velocity / GEARING


@dataclass(frozen=True)
class Mount:
    """A motor's mounting, as the task describes it.

    Args:
        backward: whether its shaft turns the mechanism backward.
        inverted: whether the controller is set to invert it before the program starts.
    """

    backward: bool = False
    inverted: bool = False


class Simulation:
    """All devices of a program, and the loop.

    Args:
        names: of the devices, by their identity.
        mounts: of the task's own motors, by the number of their port.
        refill: gives a program the steps of one more loop.
    """

    def __init__(
        self, names: dict[int, str], mounts: dict[Any, Mount], refill: Callable[[], None]
    ) -> None:
        self.names, self.mounts, self.refill = names, mounts, refill
        self.motors = [one for one in WORLD.devices if isinstance(one, Motor)]
        self.leaders = {id(one): self.find_leader(one) for one in self.motors}
        own = [one for one in self.motors if self.leaders[id(one)] is None]
        self.loads = {id(one): Load(number, one._shaft) for number, one in enumerate(own)}
        self.turned_by: dict[int, Motor] = {}
        self.jammed = False  # whether the mechanism stands still whatever happens
        self.hiccup = False  # whether something else takes current at the moment
        for one in self.motors:
            leader = self.leaders[id(one)]
            if leader is not None:
                one._shaft = leader._shaft
        self.link_sensors(own)

    def name(self, device: Device) -> str:
        """The name of the field that holds a device."""
        number = find_device_number(device)
        place = WORLD.devices.index(device) if number is None else number
        return self.names.get(id(device)) or f"{type(device).__name__} {place}"

    def find_leader(self, motor: Motor) -> Motor | None:
        """The last leader in the chain that a motor follows; None if it follows no motor."""
        seen = {id(motor)}
        one = motor
        while one._leader is not None:
            found = one._leader if isinstance(one._leader, Motor) else self._at_port(one._leader)
            if found is None or id(found) in seen:
                return None
            seen.add(id(found))
            one = found
        return None if one is motor else one

    def _at_port(self, port: Any) -> Motor | None:
        """The motor with a port."""
        return next((one for one in self.motors if one._port == port), None)

    def link_sensors(self, motors: list[Motor]) -> None:
        """Let each sensor be turned by a motor: the one it is linked to, named like, or in line."""
        sensors = [
            one for one in WORLD.devices
            if not isinstance(one, Motor) and hasattr(one, "_shaft") and one._port
        ]  # fmt: skip
        for place, sensor in enumerate(sensors):
            linked = [one for one in motors if getattr(one, "_turned_by", None) == sensor._port]
            if not motors:
                return
            near = linked or self._find_motors_named_like(sensor, motors)
            chosen = (
                near[0]
                if near
                else motors[min(place * len(motors) // len(sensors), len(motors) - 1)]
            )
            absolute = type(sensor).__name__ in ABSOLUTE and not linked
            shaft: Any = GearedShaft(chosen._shaft) if absolute else chosen._shaft
            sensor._shaft = shaft
            self.turned_by[id(sensor)] = chosen

    def _find_motors_named_like(self, sensor: Device, motors: list[Motor]) -> list[Motor]:
        """The one motor whose name shares most words with a sensor's; [] if there are several."""
        words = split_words(self.name(sensor))
        scores = [(len(words & split_words(self.name(one))), one) for one in motors]
        best = max(score for score, _ in scores)
        found = [one for score, one in scores if score == best and best]
        return found if len(found) == 1 else []

    def direction(self, motor: Motor) -> float:
        """1 if a positive voltage of the motor drives the task's mechanism forward, else -1."""
        mount = self.mounts.get(find_device_number(motor), Mount())
        return -1.0 if mount.backward != motor._inverted and self.mounts else 1.0

    def find_voltage_share(self, motor: Motor) -> float:
        """The share of the requested voltage that a motor gets at the moment."""
        if not self.hiccup:
            return 1.0
        leader = self.find_leader(motor) or motor
        duty = leader._command.kind == "duty"
        return (SAGGED / BATTERY if duty else 1.0) * self.get_through(leader)

    def get_through(self, motor: Motor) -> float:
        """The share of the voltage that a motor's current limit lets through, by motor."""
        if not self.hiccup or motor._port[0] == "PWM":
            return 1.0
        return LIMITED ** (1 + list(self.leaders).index(id(motor)) % MOST_LIMITS)

    def settle(self) -> None:
        """Fix the voltage of every motor until the next loop."""
        for one in self.motors:
            if one._leader is None:
                one._fix_voltage(self.get_through(one))
        for one in self.motors:
            if one._leader is not None:
                leader = self.find_leader(one)
                if leader is None:
                    one._applied = 0.0
                elif hasattr(one, "_follow"):
                    one._follow(leader)
                else:
                    one._applied = -leader._applied if one._opposed else leader._applied

    def run_loop(self, run: Callable[[], Any]) -> None:
        """Run one loop of the program, then let the mechanism move."""
        self.refill()
        for one in self.motors:
            one._commands.clear()
        run()
        for other in list(WORLD.each_loop):  # they may end themselves
            other()
        self.settle()
        for motor in self.motors:
            load = self.loads.get(id(motor))
            if load is not None and not self.jammed and not isinstance(motor._applied, Unknown):
                sign = -1.0 if motor._inverted else 1.0
                load.move(sign * motor._applied)
        WORLD.time += PERIOD


def find_device_number(device: Device) -> int | None:
    """The CAN ID or the port number of a device; None if it is unknown."""
    return next((one for one in device._port if isinstance(one, int)), None)


def split_words(name: str) -> set[str]:
    """The words of a name: ``left`` and ``encoder`` of ``m_leftEncoder``."""
    spread = "".join(f" {sign.lower()}" if sign.isupper() else sign for sign in name)
    return {word for word in spread.replace("_", " ").replace(".", " ").split() if len(word) > 1}


def walk_fields(
    thing: object, *, leave: Callable[[Any], bool] = lambda _: False
) -> Iterator[tuple[str, str, Any]]:
    """An object's fields and their values, each object once.

    Args:
        thing: where to begin.
        leave: objects that are not looked into, nor given.

    Yields:
        The name of the field, the whole way there, and the object.
    """
    seen: set[int] = set()
    waiting: list[tuple[str, str, Any, int]] = [("", "", thing, 0)]
    while waiting and len(seen) < MOST_OBJECTS:
        name, way, one, depth = waiting.pop(0)
        if (
            id(one) in seen
            or isinstance(one, str | bytes | int | float | type | Unknown)
            or leave(one)
        ):
            continue
        seen.add(id(one))
        yield name, way, one
        if depth < DEEP and not isinstance(one, Device):
            below = [
                (n, f"{way}.{n}".lstrip(".").replace(".[", "["), v) for n, v in _list_fields(one)
            ]
            waiting += [
                (n if not n.startswith("[") else f"{name}{n}", w, v, depth + 1) for n, w, v in below
            ]


def _list_fields(one: Any) -> list[tuple[str, Any]]:
    if isinstance(one, dict):
        return [(f"[{key}]", value) for key, value in one.items()]
    if isinstance(one, list | tuple | set | frozenset):
        return [(f"[{at}]", value) for at, value in enumerate(one)]
    own = getattr(one, "__dict__", {})
    java = getattr(type(one), "java", None)
    statics = java.statics if java is not None else {
        k: v for k, v in vars(type(one)).items() if not k.startswith("_") and not callable(v)
    }  # fmt: skip
    both = {**statics, **own}.items()
    return [(key.lstrip("."), value) for key, value in both if not key.startswith(("__", "$"))]
