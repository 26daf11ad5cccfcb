"""Robot code that forges what its run shows earns nothing by it."""

import json

import pytest
from robot_mistakes import ROOT, changed, needs_robot

from grader.exercise import Exercise
from grader.robotcode import bench
from grader.robotcode.bench import Outcome

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
        (tmp_path / "trick.py").write_text(SHARE + trick, "utf-8")
        path = tmp_path / "mine.py"
        path.write_text(changed(*HALVED, *changes), "utf-8")
        return path

    return write


@needs_robot
def test_what_a_program_wrote_that_left_early_is_not_believed(mine):
    run = bench.run(mine(WRITE + LEAVE), "ExampleSubsystem")

    assert run.outcome is Outcome.CRASHED
    assert run.said == "your code ended the robot program in the middle of a test"


@needs_robot
@pytest.mark.parametrize("trick", [""])
def test_halved_volts_earn_no_full_marks(mine, trick):
    grade = EXERCISE.grade(mine(trick), student="ann")
    print(grade)
    assert grade.score < 15
