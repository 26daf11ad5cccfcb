"""A square swerve drive as two mechanisms: going straight, and turning on the spot.

    straight:  V = kS + kV·v + kA·v'            turning:  V = kS' + kV·R·ω + kA'·ω'

    R = trackwidth/√2        kA = c·(m + m_w)        kA' = c·(J + m_w·R²)/R

with c [V/N] the voltage per force at the floor, m_w = n·J_w/r² the equivalent mass of wheels and
rotors of inertia J_w, and R the distance of a wheel from the center. The modules are at the corners
and push at a right angle to the diagonal, so R is the lever arm. While the robot turns, each wheel
also pivots on the carpet: this scrub [N·m] is added to friction.

The largest traction is µ·m·g, so the wheels slip at v' = µ·g and at ω' = (µ·m·g·R - scrub)/J.
"""

import math
from dataclasses import dataclass, replace

from sim.bench.mechanism import Mechanism, Sensor
from sim.core.units import GRAVITY
from sim.physics.motors import Motor, find_motor

WHEELS = Sensor(resolution=2.3e-5, velocity_noise=0.0075, noise_speed=0.05, jitter=0.0004)
GYRO = Sensor(resolution=1e-4, velocity_noise=0.01, noise_speed=0.05, jitter=0.0004)
"""The sensors going straight and turning. The gyro's figures are assumed: a hundredth of a degree,
and half a degree per second in motion."""


@dataclass(frozen=True)
class SwerveDrive:
    """A square swerve drive.

    Args:
        motor: the drive motor of each module.
        ratio: [1] motor turns per turn of a wheel.
        wheel_radius: [m] radius of a wheel.
        trackwidth: [m] distance of two neighboring wheels.
        mass: [kg] of the robot with battery and bumpers.
        inertia: [kg·m²] of the robot about its vertical axis.
        wheel_inertia: [kg·m²] of one wheel with its gears and rotor, at the wheel.
        friction: [V] kS going straight.
        drag: [1] share by which kV exceeds that of the motor.
        scrub: [N·m] friction torque of the carpet on a robot that turns on the spot.
        grip: [1] coefficient of friction between wheels and carpet.
        modules: number of modules.
        stator: [A] limit of a motor's current.
    """

    motor: Motor
    ratio: float
    wheel_radius: float
    trackwidth: float
    mass: float
    inertia: float
    wheel_inertia: float
    friction: float
    drag: float = 0.0
    scrub: float = 4.0
    grip: float = 1.1
    modules: int = 4
    stator: float = 120.0

    @property
    def lever_arm(self) -> float:
        """[m] lever arm of a wheel's force about the center of the robot."""
        return self.trackwidth / math.sqrt(2.0)

    @property
    def wheel_mass(self) -> float:
        """[kg] equivalent mass of wheels, gears and rotors in straight motion."""
        return self.modules * self.wheel_inertia / self.wheel_radius**2

    @property
    def traction_limit(self) -> float:
        """[N] largest force before the wheels slip."""
        return self.grip * self.mass * GRAVITY

    @property
    def slip_current(self) -> float:
        """[A] current of one motor, against a wall, at which the wheels begin to slip.

        It includes the current of the gears' friction, kS over the motor's resistance.
        """
        torque = self.traction_limit * self.wheel_radius / (self.modules * self.ratio)
        return torque / self.motor.torque_constant + self.friction / self.motor.resistance

    @property
    def translation(self) -> Mechanism:
        """The drive going straight."""
        return Mechanism(
            name="swerve",
            summary="a swerve drive going straight, its wheels locked forward",
            type="simple",
            units="meters",
            motor=self.motor,
            motor_count=self.modules,
            ratio=self.ratio,
            radius=self.wheel_radius,
            load=self.mass,
            friction=self.friction,
            drag=self.drag,
            spin=self.wheel_mass / self.mass,
            travel=10.0,
            sensor=WHEELS,
            spread={},
            stator=self.stator,
            grip=self.grip * GRAVITY,
        )

    @property
    def rotation(self) -> Mechanism:
        """The drive turning on the spot, read by a gyro in degrees."""
        volts_per_torque = (
            self.motor.resistance
            * self.wheel_radius
            / (self.modules * self.motor.torque_constant * self.ratio * self.lever_arm)
        )
        return replace(
            self.translation,
            name="swerve-rotation",
            summary="a swerve drive turning on the spot, read by a gyro in degrees",
            units="degrees",
            radius=self.wheel_radius / self.lever_arm,
            load=self.inertia,
            friction=self.friction + volts_per_torque * self.scrub,
            spin=self.wheel_mass * self.lever_arm**2 / self.inertia,
            travel=None,
            sensor=GYRO,
            grip=(self.traction_limit * self.lever_arm - self.scrub) / self.inertia,
        )


SWERVE = SwerveDrive(
    motor=find_motor("neo"),
    ratio=6.12,
    wheel_radius=0.0508,
    trackwidth=0.58,
    mass=64.0,
    inertia=5.8,
    wheel_inertia=0.0021,
    friction=0.20,
    grip=1.2,
)
"""Four NEO at 6.12:1 on 4 inch wheels, a full-weight robot. It slips only above 7 V, so WPILib's
default step determines its kA; one with four Kraken X60 slips above 2.3 V."""
