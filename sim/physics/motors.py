"""DC motors as in WPILib's ``DCMotor``, and the kV that their free speed implies.

    R = 12 V / stall current            Kt = stall torque / stall current
    Ke = (12 V - R·free current) / free speed

Source: WPILib 2026.2.2, ``DCMotor``. Its two tables differ in one number, the free current of the
NEO Vortex: 3.615 A in C++, from which Python's is made, and 3.6 A in Java.
https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/wpimath/src/main/native/include/frc/system/plant/DCMotor.h
https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/wpimath/src/main/java/edu/wpi/first/math/system/plant/DCMotor.java
"""

import math
from dataclasses import dataclass

from sim.core.errors import refuse_unknown
from sim.core.units import BATTERY


@dataclass(frozen=True)
class Motor:
    """One motor at 12 V.

    Args:
        name: its name in WPILib.
        stall_torque: [N·m].
        stall_current: [A].
        free_current: [A].
        free_speed: [rad/s].
    """

    name: str
    stall_torque: float
    stall_current: float
    free_current: float
    free_speed: float

    @property
    def resistance(self) -> float:
        """[Ω] resistance of the winding."""
        return BATTERY / self.stall_current

    @property
    def torque_constant(self) -> float:
        """[N·m/A] torque per current."""
        return self.stall_torque / self.stall_current

    @property
    def back_emf(self) -> float:
        """[V·s/rad] back-EMF constant: without the voltage drop of the free current."""
        return (BATTERY - self.resistance * self.free_current) / self.free_speed


def _make_motor(name: str, torque: float, stall: float, free: float, rpm: float) -> Motor:
    return Motor(name, torque, stall, free, rpm * 2.0 * math.pi / 60.0)


MOTORS: dict[str, Motor] = {
    motor.name: motor
    for motor in (
        _make_motor("krakenX60", 7.09, 366, 2, 6000),
        _make_motor("krakenX60FOC", 9.37, 483, 2, 5800),
        _make_motor("krakenX44", 4.11, 279, 2, 7758),
        _make_motor("krakenX44FOC", 5.01, 329, 2, 7368),
        _make_motor("falcon500", 4.69, 257, 1.5, 6380),
        _make_motor("falcon500FOC", 5.84, 304, 1.5, 6080),
        _make_motor("neo", 2.6, 105, 1.8, 5676),
        _make_motor("neoVortex", 3.6, 211, 3.615, 6784),
        _make_motor("neo550", 0.97, 100, 1.4, 11000),
        _make_motor("minion", 3.17, 211, 2, 7704),
        _make_motor("cim", 2.42, 133, 2.7, 5310),
    )
}


def find_motor(name: str) -> Motor:
    """Look up a motor.

    Raises:
        BadRequest: no such motor; the message lists those there are.

    Examples:
        >>> find_motor("neo").stall_torque  # [N·m]
        2.6
    """
    refuse_unknown("motor", name, MOTORS)
    return MOTORS[name]


def compute_theoretical_kv(of: Motor, *, ratio: float, radius: float | None = None) -> float:
    """The theoretical kV: 12 V over the free speed, as teams compute it.

    Args:
        of: the motor.
        ratio: motor turns per turn of the output; below 1 for an overdrive.
        radius: [m] of wheel or drum; None for a mechanism that turns.

    Returns:
        [V·s/m], or [V·s/rad] without a radius. The exact back-EMF constant gives 0.4 to 2 % less.

    Examples:
        >>> kraken = find_motor("krakenX60")
        >>> round(compute_theoretical_kv(kraken, ratio=6.75, radius=0.0508), 2)  # [V·s/m]
        2.54
    """
    return BATTERY / of.free_speed * ratio / (radius or 1.0)
