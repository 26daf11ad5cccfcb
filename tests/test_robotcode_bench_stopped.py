"""RobotPy code that does not run to its end: crashes, endless loops, other seasons."""

import sys

import pytest
from robot_mistakes import changed, needs_robot, ran

from grader.robotcode import bench
from grader.robotcode.bench import RunOutcome, sandboxed_run
from grader.robotcode.bench.log_facts import read_facts


@needs_robot
@pytest.mark.parametrize(
    ("changes", "outcome", "said", "where"),
    [
        pytest.param(
            [("self.right_encoder.getRate()", "self.right_encoder.getSpeed()")],
            RunOutcome.CRASHED,
            "mine.py, line 51: AttributeError: 'wpilib._wpilib.Encoder' object has no",
            "log",
            id="a crash",
        ),
        pytest.param(
            [("METERS_PER_PULSE = 0.000156", "METERS_PER_PULSE = 1 / 0")],
            RunOutcome.CRASHED,
            "mine.py, line 12: ZeroDivisionError: division by zero",
            "",
            id="a crash on import",
        ),
        pytest.param(
            [("Config(rampRate", "Mechanism(rampRate")],
            RunOutcome.CRASHED,
            "TypeError: SysIdRoutine.Mechanism.__init__() got an unexpected keyword",
            "",
            id="arguments of another",
        ),
        pytest.param(
            [
                ("SysIdRoutine.Config(rampRate=0.5, stepVoltage=3.5, timeout=10.0),", "A,"),
                ("SysIdRoutine.Mechanism(self.drive, self.record, self)", "B"),
                ("A,", "SysIdRoutine.Mechanism(self.drive, self.record, self),"),
                ("            B,", "            SysIdRoutine.Config(0.5, 3.5, 10.0),"),
            ],
            RunOutcome.CRASHED,
            "AttributeError: 'Config' object has no attribute 'name'",
            "",
            id="arguments swapped",
        ),
        pytest.param(
            [("super().__init__()", "super().__init__(); raise SystemExit")],
            RunOutcome.CRASHED,
            "mine.py, line 19: SystemExit",
            "",
            id="an exit",
        ),
        pytest.param(
            [("self.left.setVoltage(voltage)", "import os; os._exit(0)")],
            RunOutcome.CRASHED,
            "your code ended the robot program in the middle of a test",
            "",
            id="a sudden end",
        ),
        pytest.param(
            [("from commands2 import", "import phoenix_7\nfrom commands2 import")],
            RunOutcome.CANNOT,
            "it imports phoenix_7, which is not here",
            "",
            id="a vendor's library",
        ),
        pytest.param(
            [("def __init__(self)", "def __init__(self, port)")],
            RunOutcome.CANNOT,
            "ExampleSubsystem() has to be given port",
            "",
            id="an argument",
        ),
        pytest.param(
            [("self.left.setVoltage", "self.left.set_voltage")],
            RunOutcome.CANNOT,
            "set_voltage is a name of 2027, and the RobotPy installed here is 2026",
            "",
            id="another season",
        ),
    ],
)
def test_what_does_not_run_says_so_in_one_line(tmp_path, changes, outcome, said, where):
    run = ran(tmp_path, changed(*changes))

    assert run.outcome is outcome, run.said
    assert said in run.said
    assert run.where == where
    assert "\n" not in run.said


@needs_robot
def test_an_endless_loop_is_ended_and_its_line_named(tmp_path):
    endless = (
        "        self.right.setVoltage(voltage)",
        "        while True:\n            pass",
    )
    run = ran(tmp_path, changed(endless), seconds=4)

    assert run.outcome is RunOutcome.ENDLESS
    assert run.where == "drive"
    assert run.line in {38, 39, 40}  # the loop, or the call before it
    assert "did not end within 4 s" in run.said


@pytest.mark.parametrize(
    "left",
    [
        "",
        "{",
        "[]",
        '{"rows": 3}',
        '{"rows": [[1]], "lasted": {}}',
        '{"crash": 1}',
        '{"presses": [3]}',
    ],
)
def test_whatever_a_child_leaves_behind_is_an_answer(tmp_path, left):
    (tmp_path / "seen.json").write_text(left, "utf-8")

    assert (
        read_facts(tmp_path, tmp_path / "a.py", ended=True, seconds=1).outcome is RunOutcome.CANNOT
    )


def test_a_child_that_does_not_end_is_ended(tmp_path):
    program = [sys.executable, "-c", "while True: pass"]

    assert sandboxed_run.run_limited(program, tmp_path, 0.5) is False
    assert (
        read_facts(tmp_path, tmp_path / "a.py", ended=False, seconds=0.5).outcome
        is RunOutcome.ENDLESS
    )


@pytest.mark.parametrize(
    ("stack", "outcome"),
    [
        ('  File "/class/mine.py", line 7 in drive\n', RunOutcome.ENDLESS),
        ('  File "/lib/wpilib/__init__.py", line 7 in run\n', RunOutcome.CANNOT),
    ],
    ids=["in the learner's code", "on a machine that is too busy"],
)
def test_only_a_loop_in_the_learners_own_code_is_blamed_on_the_learner(tmp_path, stack, outcome):
    (tmp_path / "endless.txt").write_text(stack, "utf-8")

    assert read_facts(tmp_path, tmp_path / "mine.py", ended=True, seconds=1).outcome is outcome


@needs_robot
def test_whoever_confines_the_child_starts_it(tmp_path):
    started = []

    def start(program, folder, seconds):
        started.append((program[0], folder.is_dir(), [*folder.iterdir()], seconds))
        return sandboxed_run.run_limited(program, folder, seconds)

    path = tmp_path / "mine.py"
    path.write_text(changed(), "utf-8")

    assert (
        bench.run_sysid_routine(path, "ExampleSubsystem", start=start, seconds=8).outcome
        is RunOutcome.RAN
    )
    assert started == [(sys.executable, True, [], 8 + sandboxed_run.GRACE)]
