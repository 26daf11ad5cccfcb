"""Robot code that forges what its run shows earns nothing by it."""

import json

import pytest
from robot_mistakes import ROOT, changed, needs_robot

from grader.exercise import Exercise
from grader.isolation import sandbox_parent
from grader.robotcode import bench
from grader.robotcode.bench import RunOutcome

EXERCISE = Exercise("exercise4", ROOT / "exercises" / "exercise4")
HALVED = (  # half of each voltage, hidden from whoever only reads
    ("self.left.setVoltage(voltage)", "self.left.setVoltage(voltage * share())"),
    ("self.right.setVoltage(voltage)", "self.right.setVoltage(voltage * share())"),
    ("METERS_PER_PULSE = 0", "from trick import share\n\nMETERS_PER_PULSE = 0"),
)
SHARE = "def share():\n    return float(str(0.5))\n\n\n"


def forged():
    """What the bench would leave of a right answer: four tests, each motor as it was asked."""
    rows = []
    for test, asked in (
        ("quasistatic-forward", lambda t: 0.5 * t),
        ("quasistatic-reverse", lambda t: -0.5 * t),
        ("dynamic-forward", lambda _: 3.5),
        ("dynamic-reverse", lambda _: -3.5),
    ):
        for loop in range(80):
            now, volts = len(rows) * 0.02, asked(loop * 0.02)
            rows.append([test, now, volts, [volts, volts], [now, now]])
    lasted = {"quasistatic-forward": 10.0}
    told = {"lasted": lasted, "required": True, "per_pulse": [0.000156] * 2}
    return json.dumps({**told, "motors": ["left", "right"], "rows": rows})


WRITE = f"FORGED = {forged()!r}\n"
LEAVE = "open('seen.json', 'w').write(FORGED)\nimport os\nos._exit(0)\n"


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


@pytest.fixture(params=["all there is", "Landlock as on Linux 6.7", "limits only"])
def each_level(request, monkeypatch):
    """With all the confinement this system has, with an older kernel's, and with limits only."""
    monkeypatch.setattr(sandbox_parent, "CONFINED", request.param != "limits only")
    monkeypatch.setattr(sandbox_parent, "LANDLOCK_ABI", 4 if "6.7" in request.param else None)


@needs_robot
@pytest.mark.usefixtures("each_level")
def test_what_a_program_wrote_that_left_early_is_not_believed(mine):
    run = bench.run_sysid_routine(mine(WRITE + LEAVE), "ExampleSubsystem")

    assert run.outcome is RunOutcome.CRASHED
    assert run.said == "your code ended the robot program in the middle of a test"


@needs_robot
@pytest.mark.usefixtures("each_level")
def test_a_file_that_was_changed_after_the_tests_is_not_believed(mine):
    late = "import atexit\natexit.register(lambda: open('seen.json', 'w').write(FORGED))\n"
    run = bench.run_sysid_routine(mine(WRITE + late), "ExampleSubsystem")

    assert run.outcome is RunOutcome.CRASHED


@needs_robot
def test_halved_volts_that_forge_nothing_lose_the_points_of_the_drive_callback(mine):
    grade = EXERCISE.grade(mine(""), student="ann")
    wrong = {one.id: one.seen for one in grade.checks if one.status != "passed"}

    assert grade.status == "failed"
    assert "drive" in wrong


@needs_robot
def test_a_forged_run_earns_nothing_even_where_the_code_is_not_refused(mine, monkeypatch):
    monkeypatch.setattr(bench, "refuse_tampering", lambda _: None)
    honest = EXERCISE.grade(mine(""), student="ann")
    forged = EXERCISE.grade(mine(WRITE + LEAVE), student="ann")

    drive = next(one for one in forged.checks if one.id == "drive")
    assert forged.score <= honest.score
    assert drive.status == "failed"
    assert "ended the robot program in the middle of a test" in drive.hint


TRICKS = {
    "a forged result": WRITE + LEAVE,
    "an exit": "import os\nos._exit(0)",
    "an exit by another name": "import os as o\no._exit(0)",
    "an exit of another module": "import random\nrandom._os._exit(0)",
    "an exit, imported": "from os import _exit\n_exit(0)",
    "an exit at the end": "import atexit\natexit.register(print)",
    "a signal": "import signal\nsignal.raise_signal(9)",
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
    "the log rewritten": "import pathlib\npathlib.Path('robot.wpilog').write_bytes(b'')",
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
)


@needs_robot
@pytest.mark.parametrize("text", HONEST)
def test_what_robot_programs_do_is_not_refused(tmp_path, text):
    (tmp_path / "trick.py").write_text(text, "utf-8")
    path = tmp_path / "mine.py"
    path.write_text("import trick\n" + changed(), "utf-8")

    assert EXERCISE.grade(path, student="ann").score == 15


@needs_robot
def test_a_program_that_knows_it_is_simulated_is_not_settled_by_a_run(mine):
    asks = "import wpilib\n\n\ndef share():\n    return 1 - wpilib.RobotBase.isReal() / 2\n"
    checks = {one.id: one for one in EXERCISE.grade(mine(asks), student="ann").checks}

    assert checks["drive"].status == "failed"
    assert "checks whether this is a simulation" in checks["drive"].hint
