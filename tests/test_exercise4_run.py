"""Exercise 4 read and run: what the run settles, what it contradicts, and when it is left out."""

import pytest
from robot_mistakes import RIGHT, ROOT, changed, needs_robot

from grader.exercise import Exercise
from grader.robotcode import bench
from grader.robotcode.bench import RunFacts, RunOutcome

EXERCISE = Exercise("exercise4", ROOT / "exercises" / "exercise4")


def grade_answer(tmp_path, text):
    path = tmp_path / "mine.py"
    path.write_text(text, "utf-8")
    return {one.id: one for one in EXERCISE.grade(path, student="ann").checks}


@needs_robot
def test_what_reading_cannot_tell_is_settled_by_the_run(tmp_path):
    step = ("stepVoltage=3.5", "stepVoltage=float(open(__file__).read()[3:3] or 3.5)")
    checks = grade_answer(tmp_path, changed(step))

    assert {one.status for one in checks.values()} == {"passed"}
    assert "The grader could not decide this by" in checks["step"].hint
    assert "Also run in WPILib's simulation: 0.5 V/s, 3.5 V, 10 s" in checks["routine"].hint


@needs_robot
@pytest.mark.parametrize(
    ("changes", "check", "said"),
    [
        pytest.param(
            [("stepVoltage=3.5", "stepVoltage=float(open(__file__).read()[3:3] or 2.5)")],
            "step",
            "in WPILib's simulation the step was 2.5 V",
            id="a step nobody can read",
        ),
        pytest.param(
            [("self.left = PWMSparkMax(0)", "self.left = PWMSparkMax(0); self.left.disable()")],
            "",
            "",
            id="nothing wrong",
        ),
        pytest.param(
            [("self.left_encoder.getRate()", "60 * self.left_encoder.getRate()")],
            "units",
            "60 times the slope of its position",
            id="per minute",
        ),
        pytest.param(
            [("self.right_encoder.getRate()", "[self.right_encoder.getRate()][1]")],
            "log",
            "IndexError",
            id="a crash in the log callback",
        ),
        pytest.param(
            [
                ('"right"', 'getattr(self, "name", "left")'),
                ("self.right.getVoltage()", "self.left.getVoltage()"),
                ("self.right_encoder.get", "self.left_encoder.get"),
            ],
            "log",
            "in WPILib's simulation 2 motors are driven, and the log has 1 of them",
            id="one side left out behind a name nobody can read",
        ),
        pytest.param(
            [("Encoder(2, 3, reverseDirection=True)", "Encoder(2, len('a'))")],
            "assembled",
            "mine.py, line 24: RuntimeError: PWM or DIO 1 previously allocated",
            id="one channel twice",
        ),
    ],
)
def test_what_reading_lets_pass_the_run_may_not(tmp_path, changes, check, said):
    checks = grade_answer(tmp_path, changed(*changes))
    wrong = {name: one for name, one in checks.items() if one.status != "passed"}

    assert [*wrong] == ([check] if check else [])
    for one in wrong.values():
        assert said in one.seen


@needs_robot
def test_a_question_that_the_run_cannot_settle_stays_one(tmp_path):
    text = changed(("self.right.setVoltage(voltage)", "{}['team'].send(self.right, voltage)"))
    checks = grade_answer(tmp_path, text)

    assert checks["drive"].seen.startswith("the grader cannot see")
    assert "KeyError: 'team'" in checks["drive"].hint


@needs_robot
def test_a_question_about_a_log_that_names_no_tests_stays_one(tmp_path):
    text = changed(
        ("timeout=10.0", "timeout=10.0, recordState=lambda state: None"),
        ("self.left.getVoltage()", "getattr(self.left, 'getVoltage')()"),
    )
    checks = grade_answer(tmp_path, text)

    assert checks["log"].status == "failed"
    assert checks["log"].seen.startswith(
        "the grader cannot see where the voltage of left comes from"
    )


@needs_robot
def test_code_that_reading_finds_wrong_is_not_run(tmp_path, monkeypatch):
    monkeypatch.setattr(bench, "run_sysid_routine", lambda *_: pytest.fail("it was run"))
    checks = grade_answer(tmp_path, changed(("rampRate=0.5", "rampRate=0.25")))

    assert [name for name, one in checks.items() if one.status != "passed"] == ["ramp"]


@needs_robot
def test_whoever_grades_can_leave_running_out(tmp_path, monkeypatch):
    monkeypatch.setattr(bench, "run_sysid_routine", lambda *_: pytest.fail("it was run"))
    path = tmp_path / "mine.py"
    path.write_text(RIGHT, "utf-8")

    assert EXERCISE.module.read(path, student="ann", run=False).ran is None


def test_without_robotpy_reading_is_enough(tmp_path, monkeypatch):
    monkeypatch.setattr(bench, "is_robotpy_installed", lambda: False)
    checks = grade_answer(tmp_path, RIGHT)

    assert {one.status for one in checks.values()} == {"passed"}
    assert checks["routine"].hint.startswith("Read, not compiled, not run")
    assert bench.run_sysid_routine(tmp_path / "mine.py", "ExampleSubsystem") == RunFacts(
        RunOutcome.CANNOT, "RobotPy is not installed here"
    )


def test_a_vendors_file_is_graded_by_reading_and_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(bench, "is_robotpy_installed", lambda: True)
    unable = RunFacts(RunOutcome.CANNOT, "it imports phoenix6, which is not here")
    monkeypatch.setattr(bench, "run_sysid_routine", lambda *_: unable)
    checks = grade_answer(tmp_path, RIGHT)

    assert {one.status for one in checks.values()} == {"passed"}
    assert "Only read, not run in WPILib's simulation: it imports" in checks["routine"].hint
