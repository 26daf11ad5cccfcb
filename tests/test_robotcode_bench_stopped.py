"""RobotPy code that does not run to its end: crashes, endless loops, results that mislead."""

import pytest
from robot_mistakes import MOUNTS, changed, ran

from grader.robotcode import python
from grader.robotcode.bench.facts import Outcome
from sim.core.errors import UnreadableFile


@pytest.mark.parametrize(
    ("changes", "line", "said", "where"),
    [
        pytest.param(
            [("self.right_encoder.getRate()", "self.right_encoder.getSpeed()")],
            51,
            "AttributeError: Encoder has no getSpeed",
            "log",
            id="a misspelled method",
        ),
        pytest.param(
            [("self.left.setVoltage", "self.lfet.setVoltage")],
            38,
            "AttributeError: ExampleSubsystem has no lfet. Did you mean left?",
            "drive",
            id="a misspelled field",
        ),
        pytest.param(
            [("METERS_PER_PULSE = 0.000156", "METERS_PER_PULSE = 1 / 0")],
            12,
            "ZeroDivisionError: division by zero",
            "start",
            id="a crash on import",
        ),
        pytest.param(
            [("Encoder, PWMSparkMax\n", "Encoder, PWMSparkMx\n")],
            9,
            "ImportError: wpilib has no PWMSparkMx. Did you mean PWMSparkMax?",
            "start",
            id="a misspelled import",
        ),
        pytest.param(
            [("Config(rampRate", "Mechanism(rampRate")],
            30,
            "TypeError: ",
            "start",
            id="arguments of another",
        ),
        pytest.param(
            [("super().__init__()", "super().__init__(); raise SystemExit")],
            19,
            "sys.exit() ends the program",
            "start",
            id="an exit",
        ),
        pytest.param(
            [
                ("def drive(", "def periodic(self):\n        1 / self.nothing\n\n    def drive("),
                ("super().__init__()", "super().__init__(); self.nothing = 0"),
            ],
            36,
            "ZeroDivisionError: division by zero",
            "periodic",
            id="a crash in periodic",
        ),
    ],
)  # fmt: skip
def test_a_crash_tells_its_line_and_where_it_was(tmp_path, changes, line, said, where):
    stop = ran(tmp_path, changed(*changes)).stop

    assert stop.outcome is Outcome.CRASHED
    assert said in stop.said
    assert (stop.line, stop.where) == (line, where)
    assert "\n" not in stop.said


def test_messages_show_private_names_as_the_learner_wrote_them(tmp_path):
    text = changed(("self.left", "self._left"), ("METERS_PER_PULSE", "_PULSE"))

    assert [one.name for one in ran(tmp_path, text).devices][:2] == ["_left", "right"]
    wrong = text.replace("self._left.setVoltage", "self._lfet.setVoltage")
    assert "_lfet. Did you mean _left?" in ran(tmp_path, wrong).stop.said


def test_private_names_never_meet_those_of_a_fake(tmp_path):
    private = "super().__init__(); self._subsystem_name = self._shaft = self._name = 3"

    assert ran(tmp_path, changed(("super().__init__()", private))) == ran(tmp_path, changed())


ENDLESS = "        while True:\n            pass"
HIDING = (
    "        while True:\n            try:\n                while True:\n                    pass\n"
    "            except BaseException:\n                pass"
)


def test_an_endless_loop_is_ended_and_its_line_named(tmp_path):
    text = changed(("        self.right.setVoltage(voltage)", ENDLESS))
    stop = ran(tmp_path, text).stop

    assert (stop.outcome, stop.where) == (Outcome.ENDLESS, "drive")
    assert stop.line in {39, 40}


def test_an_endless_loop_that_lets_nothing_stop_it_is_ended(tmp_path):
    text = changed(("        self.right.setVoltage(voltage)", HIDING))
    run = ran(tmp_path, text, seconds=4)

    assert run.stop.outcome is Outcome.ENDLESS
    assert not run.tests


@pytest.mark.parametrize(
    ("text", "line"),
    [("x = = 3\n", 1), ("def f():\nreturn 1\n", 2), ("import a.B;\npublic class A {}\n", 2)],
)
def test_a_text_that_is_not_python_is_refused_with_its_line(tmp_path, text, line):
    path = tmp_path / "mine.py"
    path.write_text(text, "utf-8")

    with pytest.raises(UnreadableFile) as refused:
        python.run_python(path, "routine", MOUNTS)
    assert f"line {line}" in str(refused.value.where)


@pytest.mark.parametrize(
    "left", ["", "{", "[]", "3", '{"facts": 3}', '{"facts": {"language": 1}}', "[" * 100_000]
)
def test_whatever_a_child_says_is_an_answer(tmp_path, monkeypatch, left):
    monkeypatch.setattr(
        python, "run_program", lambda *_, stdin, **__: (True, f"{stdin} {left}".encode())
    )
    run = ran(tmp_path, changed())

    assert (run.stop.outcome, run.tests) == (Outcome.CRASHED, {})
    assert run.stop.said == "the run leaves no result that can be read"


def test_what_nobody_knows_is_assumed_both_ways(tmp_path):
    text = changed(
        ("from commands2 import Subsystem\n", "from commands2 import Subsystem\nimport team\n"),
        ("self.left.setVoltage(voltage)", "self.left.setVoltage(0 if team.STILL else voltage)"),
    )
    path = tmp_path / "mine.py"
    path.write_text(text, "utf-8")
    runs = python.run_python(path, "routine", MOUNTS)

    assert [one.tests["dynamic-forward"].motors["left"].never for one in runs] == [False, True]
    assert "STILL" in runs[0].unknown
