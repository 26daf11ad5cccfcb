"""The bench moves as WPILib's own simulations do, as far as both know the same physics.

WPILib's formulas, and where they were read, stand in ``wpilib_twins.py``. A tolerance is what the
two integrators leave, and a bench that is wrong by 3 % has to miss it by a hundred times as much.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from wpilib_twins import G, arm, dc_motor, differential, elevator, flywheel, gearbox
from wpilib_twins import plant as wpimath
from wpilib_twins import simulation as wpilib

from sim.bench.mechanism import Mechanism, Sensor
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import make_power_path_array, simulate
from sim.core.log import KINDS
from sim.physics.battery import Battery
from sim.physics.engine import State, simulate_run
from sim.physics.motors import MOTORS, Motor

pytestmark = pytest.mark.robot

# [share of a signal's range] by which two may differ. Closed forms differ by rounding: 5e-13
# measured, but 6e-11 in the intake's current on a ramp, the small rest of two large voltages.
# An arm has no closed form: the bench's middle rule, in steps of at most 2.5 ms, leaves 1.4e-5 of
# this one, 4.0e-5 of 39 of 40 drawn arms, and more of one that passes upright slowly.
CLOSED, ARM = 1e-10, 5e-5
SAME_FORMULA = 1e-12  # [share of a figure, or V] for one formula in two languages
TEETH = 100.0  # [tolerances]

TWINS = {"simple": (dc_motor, CLOSED), "elevator": (elevator, CLOSED), "arm": (arm, ARM)}
PAIRS = (
    *((name, *TWINS[built.type]) for name, built in MECHANISMS.items()),
    ("drivetrain", differential, CLOSED),
    ("shooter", flywheel, CLOSED),
    ("intake", flywheel, CLOSED),
)
WITH_STOPS = (("elevator", elevator, CLOSED), ("arm", arm, ARM))
pairs = pytest.mark.parametrize(("name", "twin", "tolerance"), PAIRS)
with_stops = pytest.mark.parametrize(("name", "twin", "tolerance"), WITH_STOPS)


def quiet(built: Mechanism) -> Mechanism:
    """With a sensor that says what is; its loops are still a little early or late."""
    return replace(built, sensor=Sensor(1e-15, velocity_noise=0.0, noise_speed=1.0, jitter=0.0004))


def bare(name: str) -> Mechanism:
    """One of the catalogue, without what WPILib's simulations lack and with their gravity."""
    built = replace(
        quiet(MECHANISMS[name]),
        friction=0.0,
        drag=0.0,
        spin=0.0,
        battery=Battery(rest=14.0, resistance=0.0),
        stator=1e6,
        supply=1e6,
        brownout=0.0,
    )
    return replace(built, lift=G) if built.type == "elevator" else built


def log_of(built: Mechanism, routine: Routine):
    return simulate(built, routine, rng=np.random.default_rng(7), electrical=True)


def apart(built: Mechanism, ours, theirs: Mapping[str, np.ndarray], voltage: np.ndarray) -> float:
    """[share of a signal's range] the largest difference between two motions."""
    current = built.motor_count * ours.current * np.sign(voltage)  # as WPILib counts it
    signals = {"position": ours.position, "velocity": ours.velocity, "current": current}
    ranges = {name: np.ptp(values) for name, values in theirs.items()}
    assert min(ranges.values()) > 0.0, ranges  # what stands still proves nothing
    return max(float(np.max(np.abs(signals[n] - theirs[n])) / ranges[n]) for n in ranges)


def apart_in_tests(built: Mechanism, name: str, twin, kinds: tuple[str, ...] = KINDS) -> float:
    """How far a bench is from WPILib's simulation of the right one, over a routine's tests."""
    return max(
        apart(
            built, run, twin(bare(name), run.position[0]).follow(run.time, run.voltage), run.voltage
        )
        for run in log_of(built, Routine(ramp=0.5, step=3.5, kinds=kinds)).runs
    )


def apart_at_stops(built: Mechanism, name: str, twin, step: float | None = None) -> float:
    """The same from halfway: falls to the lower stop, is driven to the upper one, and back."""
    time = np.arange(0.0, 6.0, 0.02)
    voltage = np.select([time < 1.5, time < 3.0, time < 4.5], [0.0, 6.5, -3.0], default=5.0)
    low, high = bare(name).stops
    begin = 0.5 * (low + high)
    theirs = twin(bare(name), begin).follow(time, voltage)
    assert (theirs["position"].min(), theirs["position"].max()) == (low, high)
    state, wires = State.cold_at(begin), make_power_path_array(built)
    ours = simulate_run(
        built.model, time=time, voltage=voltage, state=state, wires=wires, step=step
    )
    return apart(built, ours, theirs, voltage)


def apart_in_figures(motor: Motor, count: int) -> float:
    """[share of a figure] how far a motor is from WPILib's of the same name."""
    theirs = gearbox(motor, count)
    figures = (
        (motor.resistance / count, theirs.R),
        (motor.torque_constant, theirs.Kt),
        (1.0 / motor.back_emf, theirs.Kv),
        (motor.stall_torque * count, theirs.stallTorque),
        (motor.stall_current * count, theirs.stallCurrent),
        (motor.free_current * count, theirs.freeCurrent),
        (motor.free_speed, theirs.freeSpeed),
    )
    return max(abs(mine / its - 1.0) for mine, its in figures)


def apart_in_volts(built: Mechanism, battery: Battery) -> float:
    """[V] how far a log's battery is from WPILib's motor and battery, over a routine's tests.

    A robot program hands BatterySim the current of its motors. A controller takes less from the
    battery, by the ratio of the voltages, and that is what the bench's battery sees.
    """
    motor, count = gearbox(built.motor, 1), built.motor_count
    worst = 0.0
    for run in log_of(built, Routine(step=5.0)).runs:
        assert np.ptp(run.bus_voltage) > 0.01, run.test
        speed = run.velocity * built.ratio / built.radius
        for v, u, bus in zip(speed, run.voltage, run.bus_voltage, strict=True):
            drawn = [motor.current(v, u) * u / bus] * count
            loaded = wpilib.BatterySim.calculate(battery.rest, battery.resistance, drawn)
            worst = max(worst, abs(loaded - bus))
    return worst


@pytest.mark.parametrize("count", [1, 2, 4])
@pytest.mark.parametrize("name", MOTORS)
def test_a_motor_has_the_figures_of_wpilib(name, count):
    assert apart_in_figures(MOTORS[name], count) < SAME_FORMULA


@pytest.mark.parametrize("name", MECHANISMS)
def test_the_gains_are_those_of_the_plant(name):
    """Of v' = A·v + B·u: kV = -A/B, kA = 1/B; of a wheel, per radian of it."""
    built, systems = bare(name), wpimath.LinearSystemId
    motors, r = gearbox(built.motor, built.motor_count), built.radius
    system = {
        "simple": lambda: systems.DCMotorSystem(motors, built.load * r**2, built.ratio),
        "elevator": lambda: systems.elevatorSystem(motors, built.load, r, built.ratio),
        "arm": lambda: systems.singleJointedArmSystem(motors, built.load, built.ratio),
    }[built.type]()
    a, b = np.ravel(system.A())[-1], np.ravel(system.B())[-1]
    turn = r if built.type == "simple" else 1.0

    assert built.gains["kV"] * turn == pytest.approx(-a / b, rel=SAME_FORMULA)
    assert built.gains["kA"] * turn == pytest.approx(1.0 / b, rel=SAME_FORMULA)


@pytest.mark.parametrize("kind", KINDS)  # ramps, steps, a sine, and voltages that reverse
@pairs
def test_a_mechanism_moves_as_in_wpilib(name, twin, tolerance, kind):
    told = "its gains are not those of its parts, or it has to be slower for steps of 2.5 ms"
    assert apart_in_tests(bare(name), name, twin, (kind,)) < tolerance, told


@with_stops
def test_a_mechanism_stops_as_in_wpilib(name, twin, tolerance):
    assert apart_at_stops(bare(name), name, twin) < tolerance


@pytest.mark.parametrize("name", MECHANISMS)
def test_the_battery_sinks_as_in_wpilib(name):
    """With all that the catalogue's mechanism has: friction, limits, battery."""
    built = quiet(MECHANISMS[name])

    assert apart_in_volts(built, built.battery) < SAME_FORMULA


@pytest.mark.parametrize("wrong", [{"spin": 0.03}, {"drag": 0.03}, {"friction": 0.05}])
@pairs
def test_comparison_with_wpilib_finds_wrong_gains(name, twin, tolerance, wrong):
    """By 3 % of kA, by 3 % of kV, by a friction of 0.05 V."""
    built = replace(bare(name), **wrong)

    assert apart_in_tests(built, name, twin, ("dynamic",)) > TEETH * tolerance
