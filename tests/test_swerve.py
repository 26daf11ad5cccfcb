"""A swerve drive on the bench, its logs, and the moment of inertia that they tell."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import sim
from sim.bench.mechanism import Sensor
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.bench.slip import compute_slip_voltage
from sim.bench.swerve import GRAVITY, SwerveDrive
from sim.bench.swerve_logs import (
    MODULES,
    RATE,
    VOLTS,
    YAW,
    YAW_RATE,
    record_modules,
    record_spin,
    record_wall_push,
    write_modules,
    write_rotation,
)
from sim.cli import sysid
from sim.core.errors import BadRequest
from sim.fit import fit
from sim.fit.physics.inertia import compute_moment_of_inertia
from sim.inspect.detect_faults import inspect
from sim.io import read_motors
from sim.io.formats.wpilog.signals import SignalGroup, write_signals
from sim.physics.motors import find_motor
from sim.reconcile import reconcile
from sim.support.command_line import run_command

pytestmark = pytest.mark.slow

GENTLE = Routine(ramp=0.5, step=2.0)
KRAKEN = SwerveDrive(
    motor=find_motor("krakenX60"),
    ratio=6.75,
    wheel_radius=0.0508,
    trackwidth=0.6,
    mass=60.0,
    inertia=5.0,
    wheel_inertia=0.0015,
    friction=0.15,
)
EXACT = Sensor(1e-9, 0.0, 0.05, 0.0)


def rng(seed=1):
    return np.random.default_rng(seed)


def both(drive, routine=GENTLE):
    """Fits of turning on the spot and of going straight."""
    return (
        fit(simulate(one, routine, rng=rng(seed)))
        for seed, one in enumerate((drive.rotation, drive.translation))
    )


# ---- the drive ----


def test_swerve_drive_has_the_gains_of_its_parts():
    """By hand: one newton at the floor takes c volts, and the lever is the diagonal's half."""
    r, kt, ke = 12 / 366, 7.09 / 366, (12 - 12 / 366 * 2) / (6000 * 2 * math.pi / 60)
    c = r * 0.0508 / (4 * kt * 6.75)
    rotors = 4 * 0.0015 / 0.0508**2
    lever = math.hypot(0.3, 0.3)

    straight, turning = KRAKEN.translation.gains, KRAKEN.rotation.gains

    assert straight["kV"] == pytest.approx(ke * 6.75 / 0.0508)
    assert straight["kA"] == pytest.approx(c * (60 + rotors))
    assert turning["kV"] == pytest.approx(straight["kV"] * lever)
    assert turning["kA"] == pytest.approx(c * (5.0 + rotors * lever**2) / lever)
    assert turning["kS"] - straight["kS"] == pytest.approx(c * 4.0 / lever)


# ---- slip ----


def quiet(mechanism):
    """The mechanism with an exact sensor, an ideal battery and no current limit."""
    ideal = replace(mechanism.battery, resistance=0.0, rest=14.0)
    return replace(mechanism, sensor=EXACT, battery=ideal, stator=1e6, supply=1e6, travel=None)


@settings(max_examples=25)
@given(step=st.floats(2.6, 12.0), grip=st.floats(0.8, 1.2))
def test_wheels_that_slip_follow_the_closed_form(step, grip):
    """While they slip, robot and wheels have speeds that one can write down."""
    one = quiet(replace(KRAKEN, grip=grip).translation)
    gains, spin = one.gains, one.spin
    log = simulate(one, Routine(ramp=0.5, step=step, timeout=1.0, kinds=("dynamic",)), rng=rng())
    run = log.runs[0]
    since = run.time - run.time[0]
    held = gains["kA"] / (1 + spin) * one.grip
    wheel = (step - gains["kS"] - held) / gains["kV"]
    tau = gains["kA"] * spin / (1 + spin) / gains["kV"]
    slipping = (since > 0) & (since < 0.9 * wheel / one.grip)

    expected = wheel * -np.expm1(-since / tau)

    assert compute_slip_voltage(one) < 2.6
    assert run.velocity[slipping] == pytest.approx(expected[slipping], abs=0.01 * wheel)
    assert run.velocity[-1] == pytest.approx((step - gains["kS"]) / gains["kV"], rel=0.01)


@pytest.mark.parametrize(("step", "found"), [(2.0, set()), (4.0, {"wheel-slip"})])
def test_step_of_ctres_generator_slips_a_kraken_drive_and_is_reported(step, found):
    """4 V is the generator's step; this robot slips from 2.3 V on."""
    log = simulate(KRAKEN.translation, Routine(ramp=0.5, step=step), rng=rng())

    assert {one.fault for one in inspect(log).damages} == found
    assert (step > compute_slip_voltage(KRAKEN.translation)) == bool(found)


def test_slip_beside_a_hidden_joint_is_left_out_with_a_warning():
    robot = KRAKEN.translation.hide("backlash")

    (doubt,) = simulate(robot, Routine(ramp=0.5, step=3.5), rng=rng()).doubts

    assert doubt.code == "slip-left-out"
    assert "above 2.3 V from standstill" in doubt.message
    assert simulate(robot, GENTLE, rng=rng()).doubts == ()


def test_grip_changes_nothing_below_the_slip_voltage():
    free = replace(KRAKEN.translation, grip=None)
    one, other = (simulate(x, GENTLE, rng=rng()) for x in (KRAKEN.translation, free))

    for run, same in zip(one.runs, other.runs, strict=True):
        assert np.array_equal(run.velocity, same.velocity)


# ---- the moment of inertia ----


def own_share(drive):
    """[kg·m²] the formula's own answer: rotors and wheels are in both kA."""
    rotors, lever = drive.wheel_mass, drive.lever_arm
    return drive.mass * (drive.inertia + rotors * lever**2) / (drive.mass + rotors)


@settings(max_examples=15)
@given(
    mass=st.floats(40.0, 68.0),
    inertia=st.floats(2.5, 8.0),
    trackwidth=st.floats(0.45, 0.7),
    wheel=st.floats(0.0010, 0.0025),
    scrub=st.floats(0.0, 8.0),
)
def test_two_tests_tell_the_moment_of_inertia(mass, inertia, trackwidth, wheel, scrub):
    drive = replace(
        KRAKEN, mass=mass, inertia=inertia, trackwidth=trackwidth, wheel_inertia=wheel, scrub=scrub
    )
    step = Routine(ramp=0.5, step=0.9 * compute_slip_voltage(drive.translation))

    found = compute_moment_of_inertia(*both(drive, step), mass=mass, lever=drive.lever_arm)

    assert found.value == pytest.approx(own_share(drive), rel=0.01)
    assert found.error < 0.02 * found.value
    assert found.lever_seen == pytest.approx(drive.lever_arm, rel=0.005)
    assert found.doubts == ()
    if 0.03 < drive.wheel_mass / mass < 0.10:
        least, most = found.without_rotors
        assert 0.99 * least < inertia < 1.01 * most


def test_half_the_trackwidth_as_lever_makes_an_inertia_of_5_read_3_5():
    """Facts: 5.0 kg·m² of a square swerve reads as 3.54 with a tank's lever."""
    light = replace(KRAKEN, wheel_inertia=0.0)
    turning, straight = both(light)

    right = compute_moment_of_inertia(turning, straight, mass=60.0, lever=light.lever_arm)
    wrong = compute_moment_of_inertia(turning, straight, mass=60.0, lever=0.3)

    assert (right.value, right.doubts) == (pytest.approx(5.0, rel=0.01), ())
    assert wrong.value == pytest.approx(3.54, abs=0.03)
    said = wrong.doubts[0].message
    assert "your logs give 0.42" in said
    assert "but you gave 0.3 m. Probably you gave half the trackwidth T" in said
    assert said.endswith("Give T/√2 for a square swerve.")
    assert wrong.doubts[0].grave


@pytest.mark.parametrize(
    ("times", "says"),
    [
        (1 / math.sqrt(2), "you gave half the trackwidth T"),
        (math.sqrt(2), "you gave the trackwidth T. Give T/√2 for a square swerve"),
        (1 / 2 / math.pi, "rotations read as radians"),
        (180 / math.pi, "degrees read as radians"),
        (1.3, "the lever, the wheel's radius or a unit is wrong"),
    ],
)
def test_a_wrong_lever_is_named(times, says):
    turning, straight = both(KRAKEN)

    found = compute_moment_of_inertia(turning, straight, mass=60.0, lever=KRAKEN.lever_arm * times)

    assert [doubt.code for doubt in found.doubts] == ["lever"]
    assert says in found.doubts[0].message


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (dict(mass=0.0), "no mass is 0 kg"),
        (dict(mass=math.nan), "no mass is nan kg"),
        (dict(lever=-1.0), "no lever is -1 m"),
    ],
)
def test_an_impossible_mass_or_lever_is_refused(change, says):
    turning, straight = both(KRAKEN)

    with pytest.raises(BadRequest, match=says):
        compute_moment_of_inertia(turning, straight, **{"mass": 60.0, **change})


def test_logs_that_changed_places_are_refused():
    turning, straight = both(KRAKEN)

    with pytest.raises(BadRequest, match="the log of turning is in meters"):
        compute_moment_of_inertia(straight, turning, mass=60.0)
    with pytest.raises(
        BadRequest, match="is in radians, so the lever cannot be computed from the speeds"
    ):
        compute_moment_of_inertia(turning, turning, mass=60.0)
    bad = replace(turning, gains={**turning.gains, "kA": -0.1})
    with pytest.raises(BadRequest, match="kA of turning is -0.1"):
        compute_moment_of_inertia(bad, straight, mass=60.0)


# ---- its logs ----


@pytest.fixture(scope="module")
def modules():
    """The logs of the four modules of a sound robot that goes straight."""
    return record_modules(KRAKEN, GENTLE, rng=rng())


@pytest.fixture(scope="module")
def logs(modules, tmp_path_factory):
    """The two files that a team with CTRE's program has."""
    folder = tmp_path_factory.mktemp("logs")
    write_modules(modules, folder / "straight.wpilog")
    turning = simulate(KRAKEN.rotation, GENTLE, rng=rng(2))
    write_rotation(turning, folder / "turning.wpilog", volts_per_rate=1.03)
    return folder


def test_four_modules_are_read_as_four_motors_and_agree(logs):
    found = read_motors(logs / "straight.wpilog")

    assert tuple(found) == MODULES
    for log in found.values():
        gains = fit(log).gains
        assert gains["kV"] == pytest.approx(KRAKEN.translation.gains["kV"], rel=1e-3)
        assert gains["kA"] == pytest.approx(KRAKEN.translation.gains["kA"], rel=5e-3)


def test_a_worn_wheel_turns_faster_and_its_kv_is_as_much_lower(tmp_path):
    worn = {"back-left": 0.95 * KRAKEN.wheel_radius}
    found = record_modules(KRAKEN, GENTLE, rng=rng(), radii=worn)
    kv = {name: fit(log).gains["kV"] for name, log in found.items()}

    assert kv["back-left"] / kv["front-left"] == pytest.approx(0.95, rel=1e-3)
    write_modules(found, tmp_path / "log.wpilog")
    assert set(read_motors(tmp_path / "log.wpilog")) == set(MODULES)


def test_an_unknown_module_is_refused():
    with pytest.raises(BadRequest, match="Choose one of: front-left, front-right"):
        record_modules(KRAKEN, GENTLE, rng=rng(), radii={"middle": 0.05})


def run(capsys, *arguments):
    code = run_command(sysid, name="sysid", arguments=[str(one) for one in arguments])
    said = capsys.readouterr()
    return code, said.out, said.err


GYRO = ("--position", YAW, "--velocity", YAW_RATE)
TURNED = ("--voltage", VOLTS.format(1), *GYRO)


def test_the_command_prints_the_moment_of_inertia(logs, capsys):
    code, said, _ = run(
        capsys, "fit", logs / "turning.wpilog", *TURNED, "--straight", logs / "straight.wpilog",
        "--mass", 60, "--lever", KRAKEN.lever_arm,
    )  # fmt: skip

    assert code == 0
    assert "simple mechanism in degrees" in said
    assert "Moment of inertia 5.2" in said
    assert "with a lever of 0.424 m." in said
    assert "without them the robot has 4.6" in said


def test_modules_that_agree_roughly_are_not_reported_to_agree_within_their_errors(tmp_path, capsys):
    """One wheel is 4 % smaller: no warning yet, but no accident of noise either."""
    worn = {"front-right": 0.96 * KRAKEN.wheel_radius}
    modules = record_modules(KRAKEN, GENTLE, rng=rng(), radii=worn)
    write_modules(modules, tmp_path / "worn.wpilog")

    _, said, _ = run(capsys, "fit", tmp_path / "worn.wpilog")

    assert "All 4 motors, each fitted alone, agree within 4.0%" in said


def test_ctres_own_log_of_going_straight_in_rotations_of_a_motor_will_do(
    tmp_path, modules, logs, capsys
):
    """Phoenix 6 logs rotations of the motor: the lever tells how many meters one is."""
    turn = KRAKEN.wheel_radius / KRAKEN.ratio  # [m] of the robot for a radian of the motor
    (module, *_) = modules.values()
    groups = []
    for one in module.runs:
        motor = "Phoenix6/TalonFX-1/"
        signals = {
            f"{motor}MotorVoltage": one.voltage,
            f"{motor}Position": one.position / turn / math.tau,
            f"{motor}Velocity": one.velocity / turn / math.tau,
        }
        tests = [(float(one.time[0]), one.test), (float(one.time[-1]) + 0.02, "none")]
        groups.append(SignalGroup(one.time, signals, {"SysIdTranslation_State": tests}))
    path = tmp_path / "rotations.wpilog"
    write_signals(groups, path, units={})

    code, said, _ = run(
        capsys, "fit", logs / "turning.wpilog", *TURNED, "--straight", path, "--mass", 60,
        "--lever", KRAKEN.lever_arm,
    )  # fmt: skip
    refused, _, why = run(
        capsys, "fit", logs / "turning.wpilog", *TURNED, "--straight", path, "--mass", 60
    )

    assert code == 0
    assert "Moment of inertia 5.22" in said
    assert "which cannot be checked" in said
    assert refused == 2
    assert "Give --lever as well" in why


def test_advantagekits_log_of_going_straight_is_read_module_by_module(
    tmp_path, modules, logs, capsys
):
    """Radians of the wheel, and a steer motor beside each drive motor that holds still."""
    groups = []
    for k, one in enumerate(modules["front-left"].runs):
        signals = {}
        for number, log in enumerate(modules.values()):
            place, own = f"/Drive/Module{number}/", log.runs[k]
            signals[f"{place}DriveAppliedVolts"] = own.voltage
            signals[f"{place}DrivePositionRad"] = own.position / KRAKEN.wheel_radius
            signals[f"{place}DriveVelocityRadPerSec"] = own.velocity / KRAKEN.wheel_radius
            signals[f"{place}TurnAppliedVolts"] = 0.02 * np.sin(own.time)
            signals[f"{place}TurnVelocityRadPerSec"] = 0.01 * np.cos(own.time)
        tests = [(float(one.time[0]), one.test), (float(one.time[-1]) + 0.02, "none")]
        groups.append(SignalGroup(one.time, signals, {"/RealOutputs/Drive/SysIdState": tests}))
    path = tmp_path / "akit.wpilog"
    write_signals(groups, path, units={})

    code, said, _ = run(capsys, "fit", path)
    _, turned, _ = run(
        capsys, "fit", logs / "turning.wpilog", *TURNED, "--straight", path, "--mass", 60,
        "--lever", KRAKEN.lever_arm,
    )  # fmt: skip

    assert code == 0
    assert "simple mechanism in radians" in said
    assert "All 4 motors, each fitted alone, agree within their errors" in said
    assert "Moment of inertia 5.2" in turned


def test_a_rate_in_place_of_a_voltage_is_reported_and_gives_no_inertia(logs, capsys):
    rate = ("--voltage", RATE, *GYRO)

    code, said, _ = run(capsys, "fit", logs / "turning.wpilog", *rate)
    refused, _, why = run(
        capsys, "fit", logs / "turning.wpilog", *rate, "--straight", logs / "straight.wpilog",
        "--mass", 60,
    )  # fmt: skip

    assert code == 0
    assert "'Rotational_Rate' is not a voltage but the rate" in said
    assert refused == 2
    assert "Name the MotorVoltage of a drive motor with --voltage." in why
    assert why.count("\n") == 1


def test_the_gyro_is_read_in_degrees_though_the_motors_are_in_rotations(logs):
    entries = {"voltage": VOLTS.format(1), "position": YAW, "velocity": YAW_RATE}
    log = sim.read(logs / "turning.wpilog", entries=entries)

    assert log.units == "degrees"
    assert fit(log).gains["kV"] == pytest.approx(KRAKEN.rotation.gains["kV"], rel=1e-3)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (("--mass", "60"), "Missing option '--straight'"),
        (("--lever", "0.4"), "Missing option '--straight'"),
        (("--straight", "x.wpilog"), "Missing option '--mass'"),
        (("--straight", "x.wpilog", "--mass", "60"), "there is no such file"),
    ],
)
def test_contradicting_swerve_options_are_refused(logs, capsys, options, says):
    code, _, why = run(capsys, "fit", logs / "turning.wpilog", *TURNED, *options)

    assert code == 2
    assert says in why


# ---- wheel radius and slip current ----


@settings(max_examples=20)
@given(radius=st.floats(0.035, 0.055), turns=st.floats(2.0, 12.0), seed=st.integers(0, 99))
def test_the_radius_of_the_wheels_follows_from_a_slow_spin(radius, turns, seed):
    drive = replace(KRAKEN, wheel_radius=radius)
    spin = record_spin(drive, turns=turns, rng=rng(seed))
    mean = np.mean(list(spin.motor_turns.values()))

    assert spin.turned * drive.lever_arm * drive.ratio / (2 * math.pi * mean) == pytest.approx(
        radius, rel=2e-3
    )


def test_the_slip_current_follows_from_a_push_at_a_wall():
    """By hand: µ·m·g on four wheels, through gears and motors, and what friction takes."""
    torque = 1.1 * 60 * GRAVITY * 0.0508 / 4 / 6.75
    by_hand = torque / (7.09 / 366) + 0.15 / (12 / 366)
    push = record_wall_push(KRAKEN, rng=rng())
    first = int(np.argmax(push.velocity > 0.0))

    assert KRAKEN.slip_current == pytest.approx(by_hand, rel=1e-6)
    assert push.current[first - 10 : first].max() == pytest.approx(by_hand, abs=2.0)
    assert push.current[first + 2 :].mean() < 0.95 * by_hand
    assert not push.velocity[:first].any()


# ---- logs of real robots ----


PIKE = "PikeRoboDevils+FRC-2022-Software~sysid~sysid_data20220305-"
CUBE = "StuyPulse+SwerveSysId~client~data.json"


@pytest.mark.shared
def test_a_real_robot_that_turned_has_a_moment_of_inertia_a_robot_can_have(real_logs, capsys):
    """A tank of 2022, some 55 kg; its track width is not known, 0.55 m is ordinary."""
    turning, straight = f"{PIKE}151809-angular.json", f"{PIKE}152235.json"

    _, said, _ = run(
        capsys, "fit", real_logs / turning, "--straight", real_logs / straight,
        "--mass", 55, "--lever", 0.275, "--json",
    )  # fmt: skip
    found = json.loads(said)["moment_of_inertia"]

    assert 2.0 < found["value"] < 6.0
    assert found["error"] > 0.05 * found["value"]  # the log is poor, and the error says so


@pytest.mark.shared
def test_real_swerve_log_is_read_and_gets_warnings(real_logs, capsys):
    """Its velocity is the position times a factor: no gains describe it, and it is said so."""
    code, _, why = run(capsys, "fit", real_logs / CUBE)

    assert code == 2
    assert "no gains describe this log" in why
    assert why.count("\n") == 1


# ---- the solvers accept it ----


@pytest.mark.parametrize("name", ["swerve", "swerve-rotation"])
def test_reconcile_finds_what_is_hidden_in_a_swerve_drive(name):
    robot = MECHANISMS[name].hide("velocity-filter", 1.5)
    logs = [
        simulate(robot, Routine(ramp=0.5, step=step, timeout=6.0), rng=rng(int(10 * step)))
        for step in (3.5, 2.5)
    ]

    story = reconcile(logs[0], validation=logs[1], type="simple")

    assert [one.effect for one in story.findings] == ["velocity-filter"]


EDWIN = "StuyPulse+Edwin~sysid~data~drivetrain"


@pytest.mark.parametrize("name", ["swerve", "swerve-rotation"])
def test_drives_of_the_catalogue_never_slip_at_the_step_of_wpilib(name):
    drawn = [MECHANISMS[name].draw(rng(seed)) for seed in range(200)]

    assert min(compute_slip_voltage(one) for one in drawn) > 7.0


def test_the_robot_cannot_be_pushed_harder_than_the_floor_holds():
    one = quiet(KRAKEN.translation)
    wheels = simulate(one, Routine(step=8.0, timeout=2.0, kinds=("dynamic",)), rng=rng())
    (run, _) = wheels.runs

    behind = run.position[-1] - 0.5 * one.grip * (run.time[-1] - run.time[0]) ** 2
    caught = float(run.time[np.argmax(np.abs(run.velocity))] - run.time[0])

    assert run.velocity[1] > 4 * one.grip * 0.02  # the wheels spin up at once
    assert caught > run.velocity[5] / one.grip  # and the robot takes its time
    assert behind < run.position[-1]


def test_the_rotation_step_of_ctres_generator_slips_too_and_two_radians_a_second_do_not():
    """Phoenix 6 26.3.0 turns a rate into rate · lever / top speed · 12 V."""
    top = KRAKEN.motor.free_speed / KRAKEN.ratio * KRAKEN.wheel_radius
    theirs, gentle = (rate * KRAKEN.lever_arm / top * 12.0 for rate in (math.pi, 2.0))

    assert theirs == pytest.approx(3.4, abs=0.05)
    assert gentle < compute_slip_voltage(KRAKEN.rotation) < theirs
    assert compute_slip_voltage(KRAKEN.rotation) == pytest.approx(2.4, abs=0.05)


def test_slip_makes_ka_too_large_and_leaves_kv():
    log = simulate(KRAKEN.translation, Routine(ramp=0.5, step=4.0), rng=rng())
    gains, true = fit(log, method="sysid").gains, KRAKEN.translation.gains

    assert gains["kV"] == pytest.approx(true["kV"], rel=0.02)
    assert gains["kA"] > 1.2 * true["kA"]


def test_missing_lever_is_computed_from_the_speeds():
    found = compute_moment_of_inertia(*both(KRAKEN), mass=60.0)

    assert found.lever == found.lever_seen == pytest.approx(KRAKEN.lever_arm, rel=1e-3)
    assert found.value == pytest.approx(own_share(KRAKEN), rel=0.01)


def test_json_holds_the_moment_of_inertia_and_a_grave_warning_of_a_wrong_lever(logs, capsys):
    code, said, _ = run(
        capsys, "fit", logs / "turning.wpilog", *TURNED, "--straight", logs / "straight.wpilog",
        "--mass", 60, "--lever", 0.3, "--json",
    )  # fmt: skip
    found = json.loads(said)

    assert code == 1
    assert found["moment_of_inertia"]["value"] == pytest.approx(3.69, abs=0.05)
    assert found["moment_of_inertia"]["lever_seen"] == pytest.approx(0.424, abs=0.001)
    assert "lever" in {one["code"] for one in found["warnings"]}


@pytest.mark.shared
def test_a_real_pair_of_logs_in_different_units_is_noticed_by_the_lever(real_logs, capsys):
    """One file has the wheel's circumference in it, the other none: kV differs sixteenfold."""
    turning, straight = f"{EDWIN}-angular.json", f"{EDWIN}.json"

    code, said, _ = run(
        capsys, "fit", real_logs / turning, "--straight", real_logs / straight,
        "--mass", 55, "--lever", 0.3, "--json",
    )  # fmt: skip

    assert code == 1
    assert "lever" in {one["code"] for one in json.loads(said)["warnings"]}
