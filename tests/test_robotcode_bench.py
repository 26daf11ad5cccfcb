"""RobotPy code on the bench: what WPILib's own simulation shows of it, mistake by mistake."""

import math

import pytest
from robot_mistakes import RIGHT, ROOT, changed, needs_robot, ran

from grader.robotcode import bench
from grader.robotcode.bench import RunOutcome, findings

FOUR = {f"{kind}-{way}" for kind in ("quasistatic", "dynamic") for way in ("forward", "reverse")}
BATTERY = 11.0  # [V] the bench's, as written in on_bench


@needs_robot
def test_the_solution_shows_the_numbers_it_was_written_with(tmp_path):
    run = ran(tmp_path, RIGHT)

    assert run.outcome is RunOutcome.RAN
    assert (run.ramp, run.step, run.timeout) == pytest.approx((0.5, 3.5, 10.0), abs=1e-6)
    assert {*run.tests} == FOUR
    assert [(one.name, one.share) for one in run.motors] == [
        ("left", pytest.approx(1, abs=0.005)),
        ("right", pytest.approx(1, abs=0.005)),
    ]
    assert [(one.name, one.encoder, one.forward, one.as_asked) for one in run.recorded] == [
        ("left", 0, True, False),
        ("right", 1, True, False),
    ]
    assert all(one.voltage == pytest.approx(1, abs=0.001) for one in run.recorded)
    assert all(one.rate == pytest.approx(1, abs=0.001) for one in run.recorded)
    assert all(one.scale == pytest.approx(1, abs=0.001) for one in run.recorded)
    sagged = [one.kept / 3.5 for one in run.recorded]
    assert sagged == pytest.approx([10.5 / BATTERY] * 2, abs=0.01)  # the battery falls by 0.5 V
    for look in (
        findings.check_driven_motors,
        findings.check_logged_motors,
        findings.check_logged_units,
    ):
        assert look(run) is None


@needs_robot
@pytest.mark.parametrize(
    ("look", "changes", "seen", "misconception"),
    [
        pytest.param(
            findings.check_driven_motors,
            [(".setVoltage(voltage)", ".set(voltage / 12)")],
            "left got 3.77 V when the test asked for 4.11 V: the battery had 11 V",
            "M-DUTY",
            id="a share of the battery",  # 4.11/12 of 11 V in steps of 22 mV
        ),
        pytest.param(
            findings.check_driven_motors,
            [("self.right.setVoltage(voltage)", "pass")],
            "right never gets a voltage",
            "",
            id="one motor not driven",
        ),
        pytest.param(
            findings.check_driven_motors,
            [(".setVoltage(voltage)", ".setVoltage(2 * voltage)")],
            "left got 8.22 V when the test asked for 4.11 V",
            "",
            id="twice the voltage",
        ),
        pytest.param(
            findings.check_logged_motors,
            [
                (
                    "self.left.setVoltage(voltage)",
                    "self.v = voltage; self.left.setVoltage(self.v)",
                ),
                ("self.left.getVoltage()", "self.v"),
            ],
            "with a weak battery, the motor got 3.35 V, and the log says 3.50 V (left)",
            "M-CMDVOLT",
            id="the voltage that was asked for",
        ),
        pytest.param(
            findings.check_logged_motors,
            [("self.left.getVoltage()", "12 * self.left.get()")],
            "the voltage in the log is 1.09 times that of left",  # 12 / 11
            "",
            id="twelve volts taken for granted",
        ),
        pytest.param(
            findings.check_logged_motors,
            [
                ("self.left_encoder.getDistance()", "-self.left_encoder.getDistance()"),
                ("self.left_encoder.getRate()", "-self.left_encoder.getRate()"),
            ],
            "a positive voltage of left gives a negative velocity",
            "",
            id="a sign",
        ),
        pytest.param(
            findings.check_logged_motors,
            [("self.right_encoder.get", "self.left_encoder.get")],
            "left and right record the same encoder",
            "",
            id="one encoder recorded twice",
        ),
        pytest.param(
            findings.check_logged_units,
            [
                ("self.left_encoder.getRate()", "self.left_encoder.getRate() * 60"),
            ],
            "the velocity of left is 60 times the slope of its position",
            "M-UNITS",
            id="per minute",
        ),
        pytest.param(
            findings.check_logged_units,
            [
                ("self.left_encoder.getDistance()", "self.left_encoder.getDistance() / 6.2832"),
            ],
            "the velocity of left is 6.28 times the slope of its position",
            "M-UNITS",
            id="radians beside rotations",
        ),
        pytest.param(
            findings.check_logged_units,
            [
                ("_encoder.getDistance()", "_encoder.getDistance() * 6.2832"),
                ("_encoder.getRate()", "_encoder.getRate() * 6.2832"),
            ],
            "left moved 1 m, and the log says 6.283 meters",
            "M-UNITS",
            id="meters taken for turns",
        ),
    ],
)
def test_a_mistake_shows_with_its_figures(tmp_path, look, changes, seen, misconception):
    run = ran(tmp_path, changed(*changes))
    fault = look(run)

    assert run.outcome is RunOutcome.RAN, run.said
    assert fault is not None
    assert seen in fault.seen
    assert fault.misconception == misconception


@needs_robot
@pytest.mark.parametrize(
    ("changes", "numbers"),
    [
        ([("rampRate=0.5", "rampRate=0.25")], (0.25, 3.5, 10)),
        ([("stepVoltage=3.5", "stepVoltage=7")], (0.5, 7, 10)),
        ([("timeout=10.0", "timeout=4")], (0.5, 3.5, 4)),
        ([("timeout=10.0", "timeout=60")], (0.5, 3.5, math.inf)),
    ],
)
def test_the_numbers_are_those_of_the_config(tmp_path, changes, numbers):
    run = ran(tmp_path, changed(*changes))

    assert (run.ramp, run.step, run.timeout) == pytest.approx(numbers, abs=1e-6)


@needs_robot
def test_mirrored_motors_are_as_right_as_others(tmp_path):
    mirrored = changed(
        ("self.right.setVoltage(voltage)", "self.right.setVoltage(-voltage)"),
        (
            "self.left = PWMSparkMax(0)",
            "self.left = PWMSparkMax(0); self.left.setInverted(True)",
        ),
    )
    run = ran(tmp_path, mirrored)

    assert [round(one.share, 2) for one in run.motors] == [1, -1]
    assert [one.forward for one in run.recorded] == [True, True]
    assert findings.check_driven_motors(run) is findings.check_logged_motors(run) is None


@needs_robot
def test_the_same_code_shows_the_same_to_the_last_digit(tmp_path):
    assert ran(tmp_path, RIGHT) == ran(tmp_path, RIGHT)


@needs_robot
def test_a_follower_in_no_field_is_seen_and_mirrored_leaders_are_no_fault():
    path = ROOT / "tests" / "robotcode" / "pwm_drive.py"  # right inverted, one follower is local
    run = bench.run_sysid_routine(path, "Drive")

    assert [(one.name, one.own) for one in run.motors] == [
        ("left", True),
        ("right", True),
        ("right_back", True),
        ("PWM 2", False),
    ]
    assert [one.forward for one in run.recorded] == [True, True]
    assert findings.check_driven_motors(run) is findings.check_logged_motors(run) is None


@needs_robot
def test_a_program_that_names_its_tests_elsewhere_is_not_blamed_for_its_log(tmp_path):
    states = ("timeout=10.0", "timeout=10.0, recordState=lambda state: None")
    run = ran(tmp_path, changed(states))

    assert (run.outcome, run.tests, run.recorded, run.lacking) == (RunOutcome.RAN, (), (), "")
    assert (run.ramp, run.step) == pytest.approx((0.5, 3.5))


@needs_robot
def test_tests_that_do_not_require_their_subsystem_are_seen(tmp_path):
    other = ("self.record, self)", "self.record, Subsystem(), 'mine')")
    fault = findings.check_requirements(ran(tmp_path, changed(other)))

    assert fault is not None
    assert "do not require the subsystem" in fault.seen


@needs_robot
@pytest.mark.parametrize("short", ["timeout=0.05", "timeout=0.09"])  # two loops, and four
def test_tests_too_short_to_tell_anything_are_no_ground_for_blame(tmp_path, short):
    run = ran(tmp_path, changed(("timeout=10.0", short)))

    assert (run.outcome, run.ramp) == (RunOutcome.RAN, pytest.approx(0.5))
    for look in (
        findings.check_driven_motors,
        findings.check_logged_motors,
        findings.check_logged_units,
    ):
        assert look(run) is None
