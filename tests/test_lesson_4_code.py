"""The code that lesson 4 shows does on a simulated robot what the lesson says."""

import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import sim
from grader.check import WrongAnswer
from grader.robotcode.checks.log import check_logged, check_units
from grader.robotcode.checks.routine import (
    check_assembled,
    check_driven,
    check_open_loop,
)
from grader.robotcode.running import run_routine
from sim.fit import fit

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
