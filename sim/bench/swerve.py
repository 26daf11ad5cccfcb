"""A square swerve drive: the mechanism that it is going straight, and the one it is turning.

    straight:  V = kS + kV·v + kA·v'            turning:  V = kS' + kV·R·ω + kA'·ω'

    R = trackwidth/√2        kA = c·(m + m_w)        kA' = c·(J + m_w·R²)/R

with c [V/N] the volts that a newton at the floor takes, m_w = n·J_w/r² the mass that wheels and
rotors of inertia J_w are worth, and R the distance of a wheel from the middle. The modules stand in
the corners and push across the diagonal, so R is the lever. While the robot turns, each wheel also
turns on its own spot of carpet: that scrub [N·m] is added to friction.

The floor holds µ·m·g in all, so the wheels slip at v' = µ·g and at ω' = (µ·m·g·R - scrub)/J.
"""

import math
from dataclasses import dataclass

from sim.bench.mechanism import Mechanism, Sensor
from sim.physics.motors import Motor, find_motor

GRAVITY = 9.81  # [m/s²]
WHEELS = Sensor(resolution=2.3e-5, velocity_noise=0.0075, noise_speed=0.05, jitter=0.0004)
GYRO = Sensor(resolution=1e-4, velocity_noise=0.01, noise_speed=0.05, jitter=0.0004)
"""What reads it going straight and turning. The gyro's figures are assumed: a hundredth of a
degree, and half a degree per second while the robot shakes."""


@dataclass(frozen=True)
class SwerveDrive:
    """A square swerve drive, as built.

    Args:
        motor: which one drives each module.
        ratio: motor turns per turn of a wheel.
        wheel_radius: [m].
        trackwidth: [m] between two neighboring wheels.
        mass: [kg] of the robot with battery and bumpers.
        inertia: [kg·m²] of the robot about its vertical axis.
        wheel_inertia: [kg·m²] of one wheel, its gears and rotor, as felt at the wheel.
        friction: [V] kS going straight.
        drag: share by which kV exceeds the motor's own.
        scrub: [N·m] by which the carpet brakes a robot that turns on the spot.
        grip: coefficient of friction between wheels and carpet.
        modules: how many.
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
        """[m] lever arm of a wheel's force about the middle of the robot."""
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

        Friction in the gears takes a part of it: kS is the voltage at which it begins to move.
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
        return Mechanism(
            name="swerve-rotation",
            summary="a swerve drive turning on the spot, read by a gyro in degrees",
            type="simple",
            units="degrees",
            motor=self.motor,
            motor_count=self.modules,
            ratio=self.ratio,
            radius=self.wheel_radius / self.lever_arm,
            load=self.inertia,
            friction=self.friction + volts_per_torque * self.scrub,
            drag=self.drag,
            spin=self.wheel_mass * self.lever_arm**2 / self.inertia,
            travel=None,
            sensor=GYRO,
            spread={},
            stator=self.stator,
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
"""Four NEO at 6.12:1 on 4 inch wheels, a full-weight robot. It slips only above 7 V, so that
WPILib's own step still tells its kA; one with four Kraken X60 slips above 2.3 V."""
