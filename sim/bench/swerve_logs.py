"""Simulated logs of a swerve drive's tests: four modules, a gyro, a spin, a push at a wall.

Going straight, all wheels have the speed of the robot and the same voltage, so the logs of the
modules differ only by the noise of their sensors and the radius of their wheels.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from sim.bench.mechanism import Sensor
from sim.bench.routine import Routine
from sim.bench.sensor_model import read_sensor
from sim.bench.simulate import simulate
from sim.bench.swerve import WHEELS, SwerveDrive
from sim.core.errors import refuse_unknown
from sim.core.log import Array, Log
from sim.core.units import find_unit
from sim.io.formats.wpilog.signals import SignalGroup, write_signals
from sim.io.formats.wpilog.writing import make_motor_groups

MODULES = ("front-left", "front-right", "back-left", "back-right")
RATE, VOLTS = "Rotational_Rate", "Phoenix6/TalonFX-{}/MotorVoltage"
YAW, YAW_RATE = "Phoenix6/Pigeon2-1/Yaw", "Phoenix6/Pigeon2-1/AngularVelocityZWorld"
"""Names in CTRE's logger: the commanded rate, the voltage of a drive motor, and the gyro."""

LOOP = 0.02  # [s] loop period of the robot program
RAMP, AFTER = 0.5, 1.0  # [V/s] of a push at a wall, [s] from the slip to its end
KINETIC = 0.9  # [share of the static friction] friction of slipping wheels
AMPERES = 0.5  # [A] noise of a measured current
DRIFT = 2e-4  # [share of the distance] error of a gyro, or of a wheel on carpet


def record_modules(
    drive: SwerveDrive,
    routine: Routine,
    *,
    rng: np.random.Generator,
    radii: Mapping[str, float] | None = None,
) -> dict[str, Log]:
    """The log of each module going straight, in meters by the radius of a new wheel.

    Args:
        drive: the swerve drive.
        routine: the tests.
        rng: random generator of noise and jitter.
        radii: module -> [m] true radius of its wheel, if it is not that of the drive.

    Raises:
        BadRequest: ``radii`` has an unknown module.
    """
    worn = dict(radii or {})
    for module in worn:
        refuse_unknown("module", module, MODULES)
    exact = Sensor(1e-9, 0.0, WHEELS.noise_speed, WHEELS.jitter)
    log = simulate(replace(drive.translation, sensor=exact), routine, rng=rng)
    logs = {}
    for module in MODULES:
        turns = drive.wheel_radius / worn.get(module, drive.wheel_radius)
        runs = []
        for run in log.runs:
            seen = read_sensor(
                WHEELS, position=turns * run.position, velocity=turns * run.velocity, rng=rng
            )
            runs.append(replace(run, position=seen.position, velocity=seen.velocity))
        logs[module] = replace(log, runs=tuple(runs))
    return logs


def write_modules(logs: Mapping[str, Log], path: Path) -> None:
    """Write the logs of some modules as one WPILOG, like a SysIdRoutine with several motors.

    Args:
        logs: module -> its log; all of the same tests at the same times.
        path: the file, ending in .wpilog.

    Raises:
        BadRequest: the file cannot be written.
    """
    groups, units = make_motor_groups(logs)
    write_signals(groups, path, units=units)


def write_rotation(log: Log, path: Path, *, volts_per_rate: float) -> None:
    """Write a log of turning on the spot like CTRE's program and logger.

    The routine commands a rate [rad/s], and the logger has the voltage of the modules. The gyro
    reads degrees.

    Args:
        log: log of turning, with the voltage of the drive motors.
        path: the file, ending in .wpilog.
        volts_per_rate: [V·s/rad] voltage of the modules per commanded rate.

    Raises:
        BadRequest: the file cannot be written.
    """
    degree = find_unit("degrees").si
    groups = []
    for run in log.runs:
        signals = {VOLTS.format(k + 1): run.voltage for k in range(len(MODULES))}
        signals[RATE] = run.voltage / volts_per_rate
        signals |= {YAW: run.position / degree, YAW_RATE: run.velocity / degree}
        texts = {"SysIdRotation_State": _list_states(run.time, run.test)}
        groups.append(SignalGroup(run.time, signals, texts))
    write_signals(groups, path, units={})


def _list_states(time: Array, test: str) -> list[tuple[float, str]]:
    """[s] times and test states: the test at its start, ``none`` after its end."""
    return [(float(time[0]), test), (float(time[-1]) + LOOP, "none")]


@dataclass(frozen=True)
class Spin:
    """Readings of gyro and motors after a slow spin on the spot.

    Args:
        turned: [rad] angle of the robot from the gyro.
        motor_turns: module -> [rot] turns of its drive motor.
    """

    turned: float
    motor_turns: Mapping[str, float]


def record_spin(
    drive: SwerveDrive,
    *,
    turns: float,
    rng: np.random.Generator,
    radii: Mapping[str, float] | None = None,
) -> Spin:
    """Simulate a slow spin without slip, with readings of the gyro and the drive motors.

    Args:
        drive: the swerve drive.
        turns: [rot] turns of the robot.
        rng: random generator of the errors of gyro and wheels.
        radii: module -> [m] true radius of its wheel, if it is not that of the drive.
    """
    worn = dict(radii or {})
    angle = 2.0 * math.pi * turns
    off = DRIFT * rng.standard_normal(1 + len(MODULES))
    motors = {}
    for module, share in zip(MODULES, off[1:].tolist(), strict=True):
        around = 2.0 * math.pi * worn.get(module, drive.wheel_radius)
        motors[module] = angle * drive.lever_arm / around * drive.ratio * (1.0 + share)
    return Spin(angle * (1.0 + float(off[0])), motors)


@dataclass(frozen=True, eq=False)
class WallPush:
    """A recorded push at a wall, with a voltage that rises slowly.

    Args:
        time: (n,) [s].
        voltage: (n,) [V] of one drive motor.
        current: (n,) [A] stator current of that motor.
        velocity: (n,) [m/s] speed of its wheel.
    """

    time: Array
    voltage: Array
    current: Array
    velocity: Array


def record_wall_push(drive: SwerveDrive, *, rng: np.random.Generator) -> WallPush:
    """Simulate a push at a wall until the wheels slip, and a little longer.

    Until the slip nothing turns, and the current is voltage over resistance. Then the traction is a
    tenth less, because kinetic friction is lower than static, and the wheels have their
    steady-state speed.

    Args:
        drive: the swerve drive, with its bumper at the wall.
        rng: random generator of the noise.
    """
    motor, gains = drive.motor, drive.translation.gains
    volts_per_newton = gains["kA"] / (drive.mass + drive.wheel_mass)
    breaks = gains["kS"] + volts_per_newton * drive.traction_limit
    slides = gains["kS"] + KINETIC * volts_per_newton * drive.traction_limit
    time = np.arange(0.0, breaks / RAMP + AFTER, LOOP)
    voltage = RAMP * time
    loose = voltage > breaks
    velocity = np.where(loose, (voltage - slides) / gains["kV"], 0.0)
    emf = motor.back_emf * drive.ratio / drive.wheel_radius * velocity
    noise = AMPERES * rng.standard_normal(time.size)
    current = np.abs((voltage - emf) / motor.resistance + noise)
    noise_v = WHEELS.velocity_noise * rng.standard_normal(time.size)
    return WallPush(time, voltage, current, np.where(loose, velocity + noise_v, 0.0))
