"""A learner's swerve drive, and its files."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from grader.answers.asked_number import BANDS, FAST, FAST_KA, AskedNumber, Band
from sim.bench.slip import compute_slip_voltage
from sim.bench.swerve import SwerveDrive
from sim.physics.motors import compute_theoretical_kv, find_motor

BATTERY = 12.0  # [V] at which a planner asks for the top speed
MODULES = ("front-left", "front-right", "back-left", "back-right")


@dataclass(frozen=True)
class Variant:
    """One learner's swerve drive, and the tests that it ran.

    Args:
        motor: of each module, by the bench's name.
        ratio: turns of the motor for one of the wheel.
        radius: [m] of the three sound wheels, as in the code.
        trackwidth: [m].
        mass: [kg].
        inertia: [kg·m²] of the robot's own.
        wheel_inertia: [kg·m²] of a wheel, its gears and rotor.
        friction: [V].
        drag: share.
        scrub: [N·m].
        grip: coefficient of friction.
        worn: the module whose wheel is smaller.
        worn_radius: [m] of that wheel.
        turns: [rot] of the slow spin.
        seed: of the noise in the files.
    """

    motor: str
    ratio: float
    radius: float
    trackwidth: float
    mass: float
    inertia: float
    wheel_inertia: float
    friction: float
    drag: float
    scrub: float
    grip: float
    worn: str
    worn_radius: float
    turns: float
    seed: int

    @property
    def drive(self) -> SwerveDrive:
        """The swerve drive for the simulation."""
        return SwerveDrive(
            motor=find_motor(self.motor),
            ratio=self.ratio,
            wheel_radius=self.radius,
            trackwidth=self.trackwidth,
            mass=self.mass,
            inertia=self.inertia,
            wheel_inertia=self.wheel_inertia,
            friction=self.friction,
            drag=self.drag,
            scrub=self.scrub,
            grip=self.grip,
        )

    @property
    def radii(self) -> Mapping[str, float]:
        """Module -> [m] of its wheel, where that is not as in the code."""
        return {self.worn: self.worn_radius}

    @property
    def step(self) -> float:
        """[V] of the dynamic tests: well below what makes the wheels slip."""
        return math.floor(8.0 * compute_slip_voltage(self.drive.translation)) / 10.0

    @property
    def volts_per_angular_speed(self) -> float:
        """[V·s/rad] by which the program turns a rate into a voltage."""
        drive = self.drive
        paper = compute_theoretical_kv(drive.motor, ratio=drive.ratio, radius=drive.wheel_radius)
        return paper * drive.lever_arm

    @property
    def asked(self) -> dict[str, AskedNumber]:
        """The numbers that are asked for, by name."""
        drive = self.drive
        straight, turning = drive.translation.gains, drive.rotation.gains
        inertia = self.mass * drive.lever_arm * turning["kA"] / straight["kA"]
        torque = drive.motor.torque_constant * drive.slip_current
        numbers = (
            ("kS", straight["kS"], "V", BANDS["kS"]),
            ("kV", straight["kV"], "V·s/m", BANDS["kV"]),
            ("kA", straight["kA"], "V·s²/m", BANDS["kA"]),
            ("worn_radius", self.worn_radius, "m", Band(0.01, 0.02)),
            ("lever", drive.lever_arm, "m", Band(0.01, 0.01)),
            ("kA_turning", turning["kA"], "V·s²/rad", _make_ka_band(turning)),
            ("inertia", inertia, "kg·m²", Band(0.08, 0.16)),
            ("slip_current", drive.slip_current, "A", Band(0.06, 0.12)),
            ("top_speed", (BATTERY - straight["kS"]) / straight["kV"], "m/s", Band(0.04, 0.08)),
            ("max_torque", torque, "N·m", Band(0.07, 0.14)),
        )
        return {name: AskedNumber(name, value, unit, band) for name, value, unit, band in numbers}


def _make_ka_band(gains: Mapping[str, float]) -> Band:
    return FAST_KA if gains["kA"] < FAST * gains["kV"] else BANDS["kA"]
