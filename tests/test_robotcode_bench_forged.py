"""Robot code that never stops, or forges what its run shows, is stopped and earns nothing by it."""

import json

import pytest
from robot_mistakes import MOUNTS, RIGHT, ROOT, changed, ran

from grader.exercise.exercise import Exercise
from grader.isolation import sandbox_parent
from grader.robotcode import python
from grader.robotcode.bench.facts import Outcome, to_json
from sim.core.errors import UnreadableFile

EXERCISE = Exercise("exercise4", ROOT / "exercises" / "exercise4")
HALVED = (  # half of each voltage, hidden from whoever only reads
    ("self.left.setVoltage(voltage)", "self.left.setVoltage(voltage * share())"),
    ("self.right.setVoltage(voltage)", "self.right.setVoltage(voltage * share())"),
    ("METERS_PER_PULSE = 0", "from trick import share\n\nMETERS_PER_PULSE = 0"),
)
SHARE = "def share():\n    return float(str(0.5))\n\n\n"
LEAVE = "import os\nos._exit(0)\n"


@pytest.fixture
def write(tmp_path):
    """Prints what the bench would say of a right answer, on every channel that is open."""
    facts = to_json(ran(tmp_path, RIGHT))
    text = json.dumps({"facts": facts, "undecided": False})
    return (
        f"import os\nfor channel in range(20):\n    try:\n        os.write(channel, {text!r}"
        ".encode())\n    except OSError:\n        pass\n"
    )


@pytest.fixture
def mine(tmp_path):
    """Writes the halved answer with a trick beside it."""

    def write(trick, *changes):
        text = trick if "def share" in trick else f"{trick}\n{SHARE}"
        (tmp_path / "trick.py").write_text(text, "utf-8")
        path = tmp_path / "mine.py"
        path.write_text(changed(*HALVED, *changes), "utf-8")
        return path

    return write


@pytest.fixture
def tampering_allowed(monkeypatch):
    """Lets through what is refused, to see that it would be of no use."""
    monkeypatch.setattr(python, "refuse_tampering", lambda _: None)


@pytest.fixture(params=["all there is", "Landlock as on Linux 6.7", "limits only"])
def each_level(request, monkeypatch):
    """With all the confinement this system has, with an older kernel's, and with limits only."""
    monkeypatch.setattr(sandbox_parent, "CONFINED", request.param != "limits only")
    monkeypatch.setattr(sandbox_parent, "LANDLOCK_ABI", 4 if "6.7" in request.param else None)


@pytest.mark.usefixtures("each_level", "tampering_allowed")
def test_output_of_a_program_that_exits_early_is_not_trusted(mine, write):
    (run,) = python.run_python(mine(write + LEAVE), "routine", MOUNTS)

    assert run.stop.outcome is Outcome.CRASHED
    assert run.stop.said == python.ENDED
    assert not run.tests


@pytest.mark.usefixtures("tampering_allowed")
def test_output_before_the_facts_makes_them_unreadable(mine, write):
    (run,) = python.run_python(mine(write), "routine", MOUNTS)

    assert run.stop.outcome is Outcome.CRASHED
    assert not run.tests


def test_halved_volts_that_forge_nothing_lose_the_points_of_the_drive_callback(mine):
    grade = EXERCISE.grade(mine(""), student="ann")
    wrong = {one.id: one.seen for one in grade.checks if one.status != "passed"}

    assert grade.status == "failed"
    assert "drive" in wrong


@pytest.mark.usefixtures("tampering_allowed")
def test_a_forged_run_earns_nothing_even_where_the_code_is_not_refused(mine, write):
    forged = EXERCISE.grade(mine(write + LEAVE), student="ann")

    assert forged.score == 0
    assert python.ENDED in forged.checks[0].seen


PRIVATE = (
    "self.left._ask('voltage', voltage)",
    "self.left._commands.clear()",
    "self.right._applied = voltage",
    "getattr(self.left, '_shaft').velocity = 0",
)


@pytest.mark.parametrize("statement", PRIVATE)
def test_private_state_of_the_bench_cannot_be_reached(tmp_path, statement):
    text = changed(("self.left.setVoltage(voltage)", f"voltage = 2 * voltage; {statement}"))
    run = ran(tmp_path, text)

    assert run.stop or run.tests["dynamic-forward"].motors["left"].never


TRICKS = {
    "an exit": "import os\nos._exit(0)",
    "an exit by another name": "import os as o\no._exit(0)",
    "an exit of another module": "import random\nrandom._os._exit(0)",
    "an exit, imported": "from os import _exit\n_exit(0)",
    "an exit at the end": "import atexit\natexit.register(print)",
    "a signal": "import signal\nsignal.raise_signal(9)",
    "the bench": "from grader.robotcode.library.world import WORLD",
    "the nonce, by the stack": "import sys\nprint(sys._getframe().f_back.f_locals)",
    "the nonce, by an error": "try:\n    1 / 0\nexcept Exception as e:\n    e.__traceback__",
    "the nonce, by the collector": "import gc\ngc.get_objects()",
    "the nonce, by a tracer": "import threading\nthreading.settrace(print)",
    "a motor's method replaced": "import wpilib\nwpilib.PWMSparkMax.setVoltage = print",
    "... by another name": "import wpilib\nM = wpilib.PWMSparkMax\nM.setVoltage = print",
    "... by its type": "def f(motor):\n    type(motor).speed = print",
    "... by its class": "def f(motor):\n    motor.__class__.speed = print",
    "... by setattr": "import wpilib\nsetattr(wpilib.PWMSparkMax, 'setVoltage', print)",
    "... by a mock": "from unittest import mock",
    "... by its dict": "import wpilib\nwpilib.__dict__",
    "a log's method replaced": "from wpilib.sysid import SysIdRoutineLog as L\nL.motor = print",
    "json replaced": "import json\njson.dumps = print",
    "Python's own open replaced": "import builtins\nbuiltins.open = print",
    "text as code": "exec('1')",
    "text as code, later": "import timeit\ntimeit.timeit('1')",
    "an import by text": "__import__('o' + 's')",
    "a name by text": "import wpilib\ngetattr(wpilib, 'a' + 'b')",
    "the modules": "import sys\nsys.modules.clear()",
    "machine code": "import ctypes",
    "code in an encoding that hides it": "# coding: utf-7\n# +AAo-import os",
    "code that is written first": "open('more.py', 'w').write('')",
    "a file rewritten": "import pathlib\npathlib.Path('more.py').write_bytes(b'')",
}


@pytest.mark.parametrize("trick", TRICKS)
def test_code_that_reaches_into_python_or_wpilib_earns_nothing(mine, trick):
    grade = EXERCISE.grade(mine(TRICKS[trick]), student="ann")

    assert (grade.status, grade.score) == ("ungradable", 0)
    assert "so the grader cannot see what this code does" in grade.reason
    assert "trick.py, line" in grade.reason
    assert "fault of the course" not in grade.reason


def test_a_file_in_the_place_of_wpilibs_own_earns_nothing(mine, tmp_path):
    path = mine("")
    (tmp_path / "wpimath.py").write_text("", "utf-8")

    assert "replaces WPILib's own" in EXERCISE.grade(path, student="ann").reason


HONEST = (
    "import os\nHERE = os.path.join(os.getcwd(), 'deploy')",
    "import json\ntry:\n    json.load(open('constants.json'))\nexcept OSError:\n    pass",
    "import sys\nprint(sys.version_info, file=sys.stderr)",
    "from pathlib import Path\nNOTE = Path(__file__).parent / 'note.txt'",
    "class A:\n    def __init__(self):\n        super().__init__()\na = A()\na.b = 2",
    "import threading, time, math, typing, enum, functools, logging\nlogging.info(__name__)",
    "import random\nrandom.seed(3)\nrandom.random()",
)


@pytest.mark.parametrize("text", HONEST)
def test_ordinary_calls_of_robot_programs_are_not_refused(tmp_path, text):
    (tmp_path / "trick.py").write_text(text, "utf-8")
    path = tmp_path / "mine.py"
    path.write_text("import trick\n" + changed(), "utf-8")

    assert EXERCISE.grade(path, student="ann").score == 15


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
def test_a_crash_is_reported_with_its_line_and_its_callback(tmp_path, changes, line, said, where):
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


def test_an_endless_loop_that_catches_every_exception_is_ended(tmp_path):
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
def test_any_output_of_the_child_becomes_a_result(tmp_path, monkeypatch, left):
    monkeypatch.setattr(
        python, "run_program", lambda *_, stdin, **__: (True, f"{stdin} {left}".encode())
    )
    run = ran(tmp_path, changed())

    assert (run.stop.outcome, run.tests) == (Outcome.CRASHED, {})
    assert run.stop.said == "the run leaves no result that can be read"


def test_unknown_condition_is_run_both_ways(tmp_path):
    text = changed(
        ("from commands2 import Subsystem\n", "from commands2 import Subsystem\nimport team\n"),
        ("self.left.setVoltage(voltage)", "self.left.setVoltage(0 if team.STILL else voltage)"),
    )
    path = tmp_path / "mine.py"
    path.write_text(text, "utf-8")
    runs = python.run_python(path, "routine", MOUNTS)

    assert [one.tests["dynamic-forward"].motors["left"].never for one in runs] == [False, True]
    assert "STILL" in runs[0].unknown
