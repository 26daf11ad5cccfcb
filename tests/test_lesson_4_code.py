"""The code that lesson 4 shows: the Java as exercise 4 reads it, the Python as a robot runs it."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import sim
from grader import robotcode
from grader.robotcode.facts import Output, Source
from sim.fit import fit

LESSON = Path(__file__).resolve().parents[1] / "lessons" / "04_wire_sysidroutine.py"
GAINS = {"kS": 0.2, "kV": 2.5, "kA": 0.4}


def shown(language, *, holding):
    """The block of code in the lesson that contains some text."""
    text = re.sub(r"^# ?", "", LESSON.read_text(encoding="utf-8"), flags=re.MULTILINE)
    blocks = re.findall(rf"^```{language}\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    (block,) = (block for block in blocks if holding in block)
    return block


@pytest.fixture(params=["java", "python"])
def facts(request, tmp_path):
    """What the examiner reads off the routine that the lesson shows as right."""
    name, holding = {"java": ("Drive.java", "class Drive"), "python": ("drive.py", "class Drive")}[
        request.param
    ]
    path = tmp_path / name
    path.write_text(shown(request.param, holding=holding), encoding="utf-8")
    return robotcode.read(path)


def test_the_routine_has_no_mistake_that_exercise_4_knows(facts):
    assert facts.problems == ()
    assert facts.is_subsystem
    assert facts.subsystem_passed
    assert (facts.config_argument, facts.mechanism_argument) == (0, 1)
    assert {call.motor for call in facts.drive} == set(facts.motors)
    assert {call.output for call in facts.drive} == {Output.VOLTAGE}
    assert all(call.uses_parameter and not call.scaled for call in facts.drive)
    assert {signal.signal for signal in facts.logged} == {"voltage", "position", "velocity"}
    assert {signal.source for signal in facts.logged if signal.signal == "voltage"} == {
        Source.APPLIED
    }
    assert {signal.family for signal in facts.logged if signal.signal != "voltage"} == {"linear"}


def test_the_routine_does_not_give_the_numbers_of_exercise_4_away(facts):
    numbers = facts.ramp.value, facts.step.value, facts.timeout.value
    assert numbers == (1.0, 2.0, 8.0)


def test_the_snippet_with_defects_has_those_that_can_be_read_off_it(tmp_path):
    path = tmp_path / "Shooter.java"
    path.write_text(
        "public class Shooter extends SubsystemBase {\n"
        "private final TalonFX m_leader = new TalonFX(1);\n"
        + shown("java", holding="m_lastRequest").partition("// in RobotContainer")[0]
        + "}\n",
        encoding="utf-8",
    )
    facts = robotcode.read(path)
    assert facts.problems == ()
    assert {call.output for call in facts.drive} == {Output.DUTY}
    (voltage,) = (signal for signal in facts.logged if signal.signal == "voltage")
    assert voltage.source is not Source.APPLIED
    assert {s.unit for s in facts.logged if s.signal != "voltage"} == {
        "Radians",
        "RadiansPerSecond",
    }
    assert facts.step.value == 7.0


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
