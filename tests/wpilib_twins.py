"""WPILib's simulations of the bench's mechanisms, built from the same parts.

WPILib's have a motor, a ratio, an inertia, gravity and hard stops; no friction, no limits, no
sensor. Its formulas, read in allwpilib and held against RobotPy 2026.2.2:

    LinearSystemId     v' = -G²·Kt/(Kv·R·J)·v + G·Kt/(R·J)·u           of what turns
                       v' = -G²·Kt/(Kv·R·r²·m)·v + G·Kt/(R·r·m)·u      elevatorSystem
    ElevatorSim        v' = … - 9.8 m/s²
    SingleJointedArm   v' = … - 3/2·(9.8 m/s²)/L·cos(x), a rod of length L that turns about its end
    stops              at or beyond one after an update: at it, and at rest
    current draw       DCMotor.current(G·v, u)·sgn(u), of all motors together

DCMotorSim and FlywheelSim take a step by the matrix exponential, exact however long. The others use
Dormand and Prince's rule, which in 2026.2.2 counts the step it would take next for the one it took
(repaired since): a loop of 20 ms of the elevator is then up to a tenth too long or too short, and
its velocity wrong by up to 1.5 %. In updates of 1 ms one step is always good enough, and the rule
wrong by about 1e-12.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import pytest

from sim.bench.mechanism import Mechanism
from sim.physics.motors import Motor

ABSENT = "RobotPy is not installed (extra `robot`)"
simulation = pytest.importorskip("wpilib.simulation", reason=ABSENT)
plant = pytest.importorskip("wpimath.system.plant", reason=ABSENT)

G = 9.8  # [m/s²] of ElevatorSim and SingleJointedArmSim
FINE = 0.001  # [s] in which Dormand and Prince's rule takes one step
NAMES = {"neo": "NEO", "neo550": "NEO550", "cim": "CIM"}  # ours -> WPILib's, where they differ


@dataclass(frozen=True)
class Twin:
    """WPILib's simulation of one of our mechanisms.

    Args:
        drive: sets the voltage [V].
        update: goes on by a time [s].
        shows: position, velocity, current [A] of all motors, as far as it has them, in our units.
        finest: [s] the longest update.
    """

    drive: Callable[[float], None]
    update: Callable[[float], None]
    shows: Mapping[str, Callable[[], float]]
    finest: float = FINE

    def follow(self, time: np.ndarray, voltage: np.ndarray) -> dict[str, np.ndarray]:
        """What it shows at every sample; each voltage holds until the next."""
        seen = {name: np.zeros(time.size) for name in self.shows}
        spans = np.diff(time, append=time[-1])
        for k, (volts, span) in enumerate(zip(voltage.tolist(), spans.tolist(), strict=True)):
            self.drive(volts)
            for name, show in self.shows.items():
                seen[name][k] = show()
            count = max(math.ceil(span / self.finest - 1e-9), 1)
            for _ in range(count):
                self.update(span / count)
        return seen


def gearbox(motor: Motor, count: int) -> plant.DCMotor:
    """WPILib's own motors of that name."""
    return getattr(plant.DCMotor, NAMES.get(motor.name, motor.name))(count)


def dc_motor(built: Mechanism, start: float) -> Twin:
    """What turns, or rolls: a mass m on wheels of radius r has the inertia m·r²."""
    motors, r = gearbox(built.motor, built.motor_count), built.radius
    system = plant.LinearSystemId.DCMotorSystem(motors, built.load * r**2, built.ratio)
    it = simulation.DCMotorSim(system, motors)
    it.setState(start / r, 0.0)
    shows = {
        "position": lambda: it.getAngularPosition() * r,
        "velocity": lambda: it.getAngularVelocity() * r,
        "current": it.getCurrentDraw,
    }
    return Twin(it.setInputVoltage, it.update, shows, finest=math.inf)


def flywheel(built: Mechanism, _start: float) -> Twin:
    """What turns and has no position."""
    motors = gearbox(built.motor, built.motor_count)
    system = plant.LinearSystemId.flywheelSystem(motors, built.load, built.ratio)
    it = simulation.FlywheelSim(system, motors)
    shows = {"velocity": it.getAngularVelocity, "current": it.getCurrentDraw}
    return Twin(it.setInputVoltage, it.update, shows, finest=math.inf)


def differential(built: Mechanism, start: float) -> Twin:
    """A drivetrain with half of the motors on each side; straight on, it never turns.

    Its moment of inertia [kg·m²] and its track [m] are then anybody's: 4 and 0.6.
    """
    motors = gearbox(built.motor, built.motor_count // 2)
    it = simulation.DifferentialDrivetrainSim(
        motors, built.ratio, 4.0, built.load, built.radius, 0.6
    )
    shows = {
        "position": lambda: it.getLeftPosition() + start,
        "velocity": it.getRightVelocity,
        "current": it.getCurrentDraw,
    }
    return Twin(lambda volts: it.setInputs(volts, volts), it.update, shows)


def elevator(built: Mechanism, start: float) -> Twin:
    """A carriage between its stops."""
    motors = gearbox(built.motor, built.motor_count)
    parts = (motors, built.ratio, built.load, built.radius, *built.stops)
    it = simulation.ElevatorSim(*parts, simulateGravity=True, startingHeight=start)
    shows = {"position": it.getPosition, "velocity": it.getVelocity, "current": it.getCurrentDraw}
    return Twin(it.setInputVoltage, it.update, shows)


def arm(built: Mechanism, start: float) -> Twin:
    """Whatever its shape, gravity moves it as it would a rod of the length 3/2·G/lift."""
    motors, length = gearbox(built.motor, built.motor_count), 1.5 * G / built.lift
    parts = (motors, built.ratio, built.load, length, *built.stops)
    it = simulation.SingleJointedArmSim(*parts, simulateGravity=True, startingAngle=start)
    shows = {"position": it.getAngle, "velocity": it.getVelocity, "current": it.getCurrentDraw}
    return Twin(it.setInputVoltage, it.update, shows)
