"""Exercise 5 read and run: every button pressed, in test mode and out of it."""

import pytest
from robot_mistakes import ROOT, needs_robot

from grader.exercise import Exercise
from grader.robotcode import bench
from grader.robotcode.bench import ButtonPress, RunOutcome

EXERCISE = Exercise("exercise5", ROOT / "exercises" / "exercise5")
RIGHT = (ROOT / "solutions" / "exercise5" / "robotcontainer.py").read_text("utf-8")
IMPORT = "import wpilib\n"
NO_GUARD = IMPORT + "wpilib.DriverStation.isTest = staticmethod(lambda: True)\n"
GOES_ON = IMPORT + "from commands2.button import Trigger\nTrigger.whileTrue = Trigger.onTrue\n"
FIRST = "the quasistatic forward test of button 1 (controller 0)"
TESTS = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")


def changed(old, new):
    assert old in RIGHT
    return RIGHT.replace(old, new)


def grade_answer(tmp_path, text, **options):
    path = tmp_path / "robotcontainer.py"
    path.write_text(text, "utf-8")
    return {one.id: one for one in EXERCISE.grade(path, student="ann", **options).checks}


@needs_robot
def test_each_button_runs_its_test_in_test_mode_while_it_is_held(tmp_path):
    path = tmp_path / "robotcontainer.py"
    path.write_text(RIGHT, "utf-8")
    ran = bench.press_buttons(path, "RobotContainer")

    assert ran.outcome is RunOutcome.RAN, ran.said
    assert ran.presses == tuple(  # A, B, X and Y are 1 to 4
        ButtonPress(test_mode=True, port=0, button=str(number), tests=(test,), stayed=False)
        for number, test in enumerate(TESTS, start=1)
    )


@pytest.mark.parametrize("part", [NO_GUARD, GOES_ON], ids=["a trigger", "a command"])
def test_code_that_replaces_a_part_of_wpilib_earns_nothing(tmp_path, part):
    path = tmp_path / "robotcontainer.py"
    path.write_text(changed(IMPORT, part), "utf-8")
    grade = EXERCISE.grade(path, student="ann")

    assert (grade.status, grade.score) == ("ungradable", 0)
    assert "it replaces" in grade.reason


@pytest.fixture
def tampering_allowed(monkeypatch):
    """Lets through what replaces parts of WPILib, to see that the run shows that, too."""
    monkeypatch.setattr(bench, "refuse_tampering", lambda _: None)


@needs_robot
@pytest.mark.usefixtures("tampering_allowed")
@pytest.mark.parametrize(
    ("change", "check", "said", "points"),
    [
        pytest.param(
            (IMPORT, NO_GUARD),
            "guard",
            f"in WPILib's simulation, outside of test mode, {FIRST} ran",
            0,
            id="a guard that guards nothing",
        ),
        pytest.param(
            (IMPORT, GOES_ON),
            "held",
            f"in WPILib's simulation {FIRST} continued after the button was released",
            1,
            id="a test that goes on",
        ),
        pytest.param(
            ("wpilib.Encoder(0, 1)", "wpilib.Encoder(0, 0)"),
            "held",
            "robotcontainer.py, line 18: RuntimeError",
            0,
            id="a crash at the start",
        ),
    ],
)
def test_what_reading_lets_pass_pressing_the_buttons_may_not(tmp_path, change, check, said, points):
    read = grade_answer(tmp_path, changed(*change), run=False)
    wrong = [
        one for one in grade_answer(tmp_path, changed(*change)).values() if one.status != "passed"
    ]

    assert {one.status for one in read.values()} == {"passed"}
    assert [one.id for one in wrong] == [check]
    assert wrong[0].seen.startswith(said)
    assert wrong[0].points == points


@needs_robot
@pytest.mark.parametrize(
    ("new", "said"),
    [
        ("import phoenix_7\n", "it imports phoenix_7, which is not here"),
        ("open('/no/such/file')\n", "it asks for what it cannot have here: FileNotFoundError"),
    ],
    ids=["a vendor's library", "a file"],
)
def test_what_cannot_be_run_is_graded_by_reading_and_says_so(tmp_path, new, said):
    checks = grade_answer(tmp_path, changed(IMPORT, IMPORT + new))

    assert {one.status for one in checks.values()} == {"passed"}
    assert f"Only read, not run in WPILib's simulation: {said}" in checks["held"].hint


@needs_robot
def test_a_chord_starts_nothing_by_one_button_and_is_left_to_reading(tmp_path):
    text = changed("testing = wpilib.DriverStation.isTest", "testing = self.driver.start()")
    checks = grade_answer(tmp_path, text)

    assert {one.status for one in checks.values()} == {"passed"}
    assert checks["held"].hint == ""


@needs_robot
def test_what_is_wrong_by_reading_or_only_to_be_read_is_not_run(tmp_path, monkeypatch):
    monkeypatch.setattr(bench, "press_buttons", lambda *_: pytest.fail("it was run"))

    assert grade_answer(tmp_path, changed(".whileTrue(", ".onTrue("))["held"].status == "failed"
    assert grade_answer(tmp_path, RIGHT, run=False)["held"].status == "passed"


def test_without_robotpy_reading_is_enough(tmp_path, monkeypatch):
    monkeypatch.setattr(bench, "is_robotpy_installed", lambda: False)
    checks = grade_answer(tmp_path, RIGHT)

    assert {one.status for one in checks.values()} == {"passed"}
    assert checks["held"].hint == "Read, not compiled, not run: RobotPy is not installed here."
