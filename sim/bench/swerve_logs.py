"""The logs that the tests of a swerve drive leave: four modules, a gyro, a spin, a push at a wall.

Straight ahead the carpet couples the modules: all wheels have the speed of the robot and the same
voltage, so that logs of modules differ only by their sensors and by the size of their wheels.
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
from sim.core.errors import BadRequest
from sim.core.log import Array, Log
from sim.core.units import find_unit
from sim.io.formats.wpilog.signals import SignalGroup, write_signals

MODULES = ("front-left", "front-right", "back-left", "back-right")
RATE, VOLTS = "Rotational_Rate", "Phoenix6/TalonFX-{}/MotorVoltage"
YAW, YAW_RATE = "Phoenix6/Pigeon2-1/Yaw", "Phoenix6/Pigeon2-1/AngularVelocityZWorld"
"""What CTRE's logger calls the rate asked for, the voltage of a drive motor, and the gyro."""

LOOP = 0.02  # [s] of the robot program
RAMP, AFTER = 0.5, 1.0  # [V/s] of a push at a wall, [s] from the slip to its end
KINETIC = 0.9  # [share of the static friction] that wheels which slip still hold
AMPERES = 0.5  # [A] noise of a measured current
DRIFT = 2e-4  # [share] of its way by which a gyro, or a wheel on carpet, is off


def record_modules(
    drive: SwerveDrive,
    routine: Routine,
    *,
    rng: np.random.Generator,
    radii: Mapping[str, float] | None = None,
) -> dict[str, Log]:
    """The log of each module of a straight drive, in meters by a new wheel's radius.

    Args:
        drive: what is tested.
        routine: which voltages.
        rng: the source of noise and jitter.
        radii: module -> [m] the radius that its wheel really has; the others' is the drive's own.

    Raises:
        BadRequest: ``radii`` names a module that there is not.
    """
    worn = dict(radii or {})
    if strange := sorted(worn.keys() - set(MODULES)):
        raise BadRequest(
            f"there is no module {strange[0]!r}", advice=f"Choose one of: {', '.join(MODULES)}."
        )
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
    """Write the logs of some modules as one WPILOG, as a SysIdRoutine with as many motors does.

    Args:
        logs: module -> its log; all of the same tests at the same times.
        path: the file, ending in .wpilog.

    Raises:
        BadRequest: the file cannot be written.
    """
    first = next(iter(logs.values()))
    groups, units = [], {}
    for k, run in enumerate(first.runs):
        signals = {}
        for module, log in logs.items():
            one = log.runs[k]
            for name, values, unit in (
                ("voltage", one.voltage, "Volt"),
                ("position", one.position, "Meter"),
                ("velocity", one.velocity, "Meter per Second"),
            ):
                entry = f"{name}-{module}-{first.mechanism}"
                signals[entry], units[entry] = values, unit
        texts = {f"sysid-test-state-{first.mechanism}": _tests(run.time, run.test)}
        groups.append(SignalGroup(run.time, signals, texts))
    write_signals(groups, path, units=units)


def write_rotation(log: Log, path: Path, *, volts_per_rate: float) -> None:
    """Write a log of turning on the spot as CTRE's program and logger do.

    The routine asks for a rate [rad/s], and the logger has the voltage that the modules made of it.
    The gyro reads degrees.

    Args:
        log: of turning, with the voltage of the drive motors.
        path: the file, ending in .wpilog.
        volts_per_rate: [V·s/rad] by which the modules turn a rate into a voltage.

    Raises:
        BadRequest: the file cannot be written.
    """
    degree = find_unit("degrees").si
    groups = []
    for run in log.runs:
        signals = {VOLTS.format(k + 1): run.voltage for k in range(len(MODULES))}
        signals[RATE] = run.voltage / volts_per_rate
        signals |= {YAW: run.position / degree, YAW_RATE: run.velocity / degree}
        texts = {"SysIdRotation_State": _tests(run.time, run.test)}
        groups.append(SignalGroup(run.time, signals, texts))
    write_signals(groups, path, units={})


def _tests(time: Array, test: str) -> list[tuple[float, str]]:
    """When a test begins, and when none runs any more."""
    return [(float(time[0]), test), (float(time[-1]) + LOOP, "none")]


@dataclass(frozen=True)
class Spin:
    """Readings of gyro and motors after a slow spin on the spot.

    Args:
        turned: [rad] by the robot, as the gyro has it.
        motor_turns: [rot] by the drive motor of each module.
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
    """Spin slowly, so that nothing slips, and read the gyro and the drive motors.

    Args:
        drive: what spins.
        turns: [rot] of the robot.
        rng: the source of what the gyro and the carpet are off by.
        radii: module -> [m] the radius that its wheel really has; the others' is the drive's own.
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
        voltage: (n,) [V].
        current: (n,) [A] of one drive motor's stator.
        velocity: (n,) [m/s] of its wheel.
    """

    time: Array
    voltage: Array
    current: Array
    velocity: Array


def record_wall_push(drive: SwerveDrive, *, rng: np.random.Generator) -> WallPush:
    """Push at a wall until the wheels slip, and a little longer.

    Until then nothing turns, and the current is voltage over resistance. Then the floor holds a
    tenth less, as rubber that slides does, and the wheels take the speed that the rest allows.

    Args:
        drive: what pushes; its bumper stands at the wall.
        rng: the source of noise.
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
    shakes = WHEELS.velocity_noise * rng.standard_normal(time.size)
    return WallPush(time, voltage, current, np.where(loose, velocity + shakes, 0.0))
