"""What motors and sensors of every vendor have in common.

A motor turns a shaft that the bench moves. The shaft knows the truth; what a device reports of it
is the device's own matter: inverted, geared, in its own unit, refreshed or not.
"""

from dataclasses import dataclass
from typing import Any

from grader.robotcode.library.base import Fake, Unknown
from grader.robotcode.library.world import WORLD


@dataclass
class Shaft:
    """The shaft of a motor: position [rot] and velocity [rot/s] of the rotor, as it is mounted."""

    position: float = 0.0
    velocity: float = 0.0


@dataclass(frozen=True)
class Command:
    """The last command that a program sent to a motor.

    Args:
        kind: ``voltage``, ``duty``, ``closed-loop``, ``current``, ``neutral`` or ``follow``.
        value: [V] of a voltage, share from -1 to 1 of a duty cycle, unknown, or 0.
        method: the call that did it: ``setVoltage``.
        line: where that call stands.
    """

    kind: str
    value: Any = 0.0
    method: str = ""
    line: int = 0


class Device(Fake):
    """Something with a port or CAN ID of its own.

    ``_port`` is what makes two devices the same: ``("CAN", "rio", 3)``, ``("PWM", 0)``,
    ``("DIO", 2)``.
    """

    _port: tuple[Any, ...] = ()

    def _register_port(self, *port: Any) -> None:  # numbers and names
        self._port = port
        self._line = WORLD.where()
        self._shaft = Shaft()
        WORLD.devices.append(self)


class Motor(Device):
    """A motor controller with its motor.

    The bench calls ``_fix_voltage`` once all code of a loop has run, which fixes what the motor
    gets, and then moves its shaft. A vendor's class calls ``_store_command`` for every command.

    ``_inverted``: plus turns the shaft backward. ``_peak``: the largest voltage [V] that its
    settings allow, forward and reverse. ``_leader``: the motor or its port that it follows.
    ``_applied``: [V] at the shaft in the motor's own direction, as it was in the last loop.
    """

    def _register_port(self, *port: Any) -> None:  # numbers and names
        super()._register_port(*port)
        self._inverted = False
        self._peak = (float("inf"), float("inf"))
        self._leader: Any = None
        self._opposed = False  # a follower that turns against its leader
        self._command = Command("neutral")
        self._commands: list[Command] = []  # of this loop, in order
        self._applied: Any = 0.0  # or unknown

    def _store_command(
        self, kind: str, value: Any = 0.0, method: str = ""
    ) -> None:  # may be unknown
        """Take a command, which holds until the next one."""
        self._command = Command(kind, value, method, WORLD.where())
        self._commands.append(self._command)
        if kind != "follow":
            self._leader = None

    def _fix_voltage(self, share: float = 1.0) -> None:
        """Fix the motor's voltage until the next loop.

        Args:
            share: of the voltage asked for that gets through: less while a current limit acts.
        """
        one = self._command
        volts: Any = 0.0
        if not WORLD.enabled:
            volts = 0.0
        elif one.kind == "voltage":
            volts = one.value
        elif one.kind == "duty":
            volts = one.value * WORLD.battery
        elif one.kind in {"closed-loop", "current"}:
            volts = Unknown(one.method)
        if not isinstance(volts, Unknown):
            high, low = (min(limit, WORLD.battery) for limit in self._peak)
            volts = max(-low, min(high, volts)) * share
        self._applied = volts

    def _read_rotor(self) -> tuple[float, float]:
        """Position [rot] and velocity [rot/s] in the motor's own direction."""
        sign = -1.0 if self._inverted else 1.0
        return sign * self._shaft.position, sign * self._shaft.velocity


@dataclass
class LogEntry:
    """One value that a program wrote into the SysId log.

    Args:
        motor: the name it logs under.
        signal: ``voltage``, ``position``, ``velocity``, ``acceleration``, ``current`` or another.
        value: in SI: V, m or rad, m/s or rad/s; unknown where it is.
        family: ``linear``, ``angular`` or empty.
        unit: as the code names it, empty where it names none.
        line: where it was written.
    """

    motor: str
    signal: str
    value: Any
    family: str = ""
    unit: str = ""
    line: int = 0
