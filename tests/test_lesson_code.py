"""What lessons ask and show: questions with feedback, and code that runs."""

import inspect
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

import sim
from grader import ask_question, enable_checkboxes
from grader.checks.check import WrongAnswer
from grader.notebook.lesson_questions import ChoiceQuestion, NumberQuestion
from grader.robotcode.checks.log import check_logged, check_units
from grader.robotcode.checks.routine import check_assembled, check_driven, check_open_loop
from grader.robotcode.running import run_routine
from sim.core.errors import BadRequest
from sim.fit import fit


@pytest.fixture
def check():
    """A question with two answers."""
    return ChoiceQuestion(
        "Which gain <moved>?", {"kS": "Friction is the same.", "kA": "Mass."}, right="kA"
    )


def test_each_answer_to_a_lessons_question_gets_feedback(check):
    assert check.feedback == ""
    assert check.answer("kS") == "Not yet. Friction is the same."
    assert check.answer("kA") == "Right. Mass."


def test_buttons_give_the_same_feedback_as_typed_answers(check):
    question, buttons, told = check._box.children
    assert question.value == "Which gain &lt;moved&gt;?"
    assert told.value == ""
    buttons.value = "kS"
    assert told.value == "<p><b>Not yet. Friction is the same.</b></p>"
    buttons.value = None
    assert told.value == ""
    shown = check._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in shown
    assert "Mass" not in shown["text/plain"]


def test_an_answer_that_is_not_there_is_refused(check):
    with pytest.raises(BadRequest, match="Choose one of: kS, kA"):
        check.answer("kV")
    with pytest.raises(BadRequest, match="none of the answers"):
        ChoiceQuestion("?", {"kS": "…"}, right="kA")


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (0.0191, "Right."),
        ("0,0191", "Right."),
        ("0.12 V·s/rot", "Right. 0.12 V·s/rot is 0.0191 V·s/rad"),
        (0.12, "radians"),
        (0.754, "39.5 = (2π)²."),
        ("many", "not one number"),
        (float("nan"), "nan"),
    ],
)
def test_wrong_number_gets_its_diagnosis(given, said):
    asked = "kV is 0.12 V·s/rot. Per radian?"
    check = NumberQuestion(asked, 0.0191, "V·s/rad", gain="kV", angular=True)

    assert said in check.answer(given)


def test_a_typed_answer_gets_the_same_feedback():
    check = NumberQuestion("Half of 3?", 1.5)
    _, typed, told = check._box.children
    typed.value = "3"
    assert "Not yet." in told.value
    typed.value = "1,5"
    assert told.value == "<p><b>Right.</b></p>"
    typed.value = " "
    assert told.value == ""


def test_a_prediction_is_answered_at_the_click_and_its_text_holds_the_numbers():
    asked = ask_question("lesson2.hold", kG=1.234, kS=0.5, less=1.0)
    assert "kG = 1.23 V" in asked.question
    assert asked.answer("it stays") == "Right. Go on, and see why."
    assert asked.answer("it sinks slowly") == "No. The answer is: it stays. Go on, and see why."


def test_a_name_without_a_question_is_refused(reads):
    with pytest.raises(BadRequest) as refused:
        ask_question("lesson0.nothing")
    reads(refused.value)


def test_ticks_are_kept_by_the_browser():
    assert "localStorage" in enable_checkboxes().data


LESSON = Path(__file__).resolve().parents[1] / "lessons" / "04_wire_sysidroutine.py"
GAINS = {"kS": 0.2, "kV": 2.5, "kA": 0.4}


def shown(language, *, holding):
    """The block of code in the lesson that contains some text."""
    text = re.sub(r"^# ?", "", LESSON.read_text(encoding="utf-8"), flags=re.MULTILINE)
    blocks = re.findall(rf"^```{language}\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    (block,) = (block for block in blocks if holding in block)
    return block


def run_code(tmp_path, name, text):
    """What the robot did with some code of the lesson."""
    (tmp_path / name).write_text(text, encoding="utf-8")
    return run_routine(tmp_path / name, mounts={"java": {}, "python": {}}, task="no task")[0]


@pytest.fixture(params=["java", "python"])
def facts(request, tmp_path):
    """What the routine does that the lesson shows as right."""
    name, holding = {"java": ("Drive.java", "class Drive"), "python": ("drive.py", "class Drive")}[
        request.param
    ]
    return run_code(tmp_path, name, shown(request.param, holding=holding))


def test_the_routine_has_no_mistake_that_exercise_4_knows(facts):
    assert facts.errors == ()
    check_driven(facts, points=3, mirrored=False)
    check_logged(facts, points=3, demanded=2)
    check_units(facts, mechanism="Drivetrain", scales={})
    check_assembled(facts)
    check_open_loop(facts)


def test_the_routine_does_not_give_the_numbers_of_exercise_4_away(facts):
    numbers = facts.ramp.value, facts.step.value, facts.timeout.value
    assert numbers == (1.0, 2.0, 8.0)


def test_the_snippet_with_defects_has_those_that_the_lesson_asks_for(tmp_path):
    text = (
        "import static edu.wpi.first.units.Units.*;\nimport com.ctre.phoenix6.hardware.TalonFX;\n"
        "import edu.wpi.first.units.measure.*;\nimport edu.wpi.first.wpilibj2.command.*;\n"
        "import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;\n"
        "public class Shooter extends SubsystemBase {\n"
        "private final TalonFX m_leader = new TalonFX(1);\n"
        + shown("java", holding="m_lastRequest").partition("// in RobotContainer")[0]
        + "}\n"
    )
    facts = run_code(tmp_path, "Shooter.java", text)

    assert facts.step.value == 7.0
    with pytest.raises(WrongAnswer):
        check_open_loop(facts)
    with pytest.raises(WrongAnswer):
        check_logged(facts, points=3, demanded=0)
    units = {
        one.unit
        for test in facts.tests.values()
        for s in test.signals.values()
        for one in s.values()
    }
    assert units >= {"Radian", "Radian per Second"}


@pytest.mark.robot
def test_the_python_runs_on_a_robot_and_its_log_gives_the_gains(tmp_path, root):
    pytest.importorskip("commands2", reason="RobotPy is not installed")
    code = tmp_path / "robot_code.py"
    code.write_text(shown("python", holding="class Drive"), encoding="utf-8")
    done = subprocess.run(
        [
            sys.executable,
            str(root / "tests" / "robot_lesson4.py"),
            str(code),
            str(tmp_path),
            "lesson4.wpilog",
            *map(str, GAINS.values()),
        ],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    log = sim.read(tmp_path / "lesson4.wpilog")
    assert log.units == "meters"
    found = fit(log, type="simple", method="sysid").gains
    assert found == pytest.approx(GAINS, rel=0.1)
    slow = log.list_runs_of_test("quasistatic-forward")[0]
    assert 5.9 < slow.time[-1] - slow.time[0] < 6.0  # let go after 6 s, well before the timeout
    assert slow.voltage[-1] == pytest.approx(6.0, abs=0.1)  # at 1 V/s


@pytest.mark.robot
def test_a_config_takes_the_ramp_rate_before_the_step():
    sysid = pytest.importorskip("commands2.sysid", reason="RobotPy is not installed")
    taken = list(inspect.signature(sysid.SysIdRoutine.Config).parameters)

    assert taken[:3] == ["rampRate", "stepVoltage", "timeout"]


PROGRAM = """
import json
import pathlib

from commands2 import CommandScheduler, RunCommand, Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import DriverStation
from wpilib.simulation import DriverStationSim

did = []
lift = Subsystem()
lift.setDefaultCommand(RunCommand(lambda: did.append("default"), lift))
routine = SysIdRoutine(
    SysIdRoutine.Config(), SysIdRoutine.Mechanism(did.append, lambda log: None, lift)
)
DriverStationSim.setEnabled(True)
DriverStationSim.notifyNewData()
DriverStation.refreshData()
test = routine.dynamic(SysIdRoutine.Direction.kForward)
test.schedule()
for _ in range(4):
    CommandScheduler.getInstance().run()
test.cancel()
CommandScheduler.getInstance().run()
CommandScheduler.getInstance().run()
pathlib.Path("did.json").write_text(json.dumps(did), encoding="utf-8")  # WPILib prints, too
"""


def test_released_test_ends_with_0_volts_and_the_default_command_starts(tmp_path):
    pytest.importorskip("commands2", reason="RobotPy is not installed")
    program = tmp_path / "program.py"
    program.write_text(PROGRAM, encoding="utf-8")

    subprocess.run([sys.executable, program], cwd=tmp_path, check=True, timeout=60)

    did = json.loads((tmp_path / "did.json").read_text(encoding="utf-8"))
    assert 7.0 in did
    end = did.index(0.0)
    assert "default" not in did[:end]
    assert did[end + 1 :]
    assert set(did[end + 1 :]) == {"default"}
