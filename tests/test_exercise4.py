"""Exercise 4: files of all kinds, and what is right in more than one way."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from robot_corpus import whole_corpus

from grader.cli import run_command
from grader.exercise import Exercise, find_exercise
from grader.robotcode import bench

ROOT = Path(__file__).resolve().parents[1]
JAVA, PYTHON = "ExampleSubsystem.java", "example_subsystem.py"
EXERCISE = Exercise("exercise4", ROOT / "exercises" / "exercise4")


@pytest.fixture
def real(tmp_path, monkeypatch):
    """A copy of the course's own exercises, in whose folder the command runs."""
    ignored = shutil.ignore_patterns("data", "__pycache__")
    shutil.copytree(ROOT / "exercises", tmp_path / "exercises", ignore=ignored)
    (tmp_path / "lessons").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "the file is empty. Write your answer into it. To get the file back as it was: "),
        (b"  \n", "NEW-FOLDER --no-lab, and take exercises/exercise4/ExampleSubsystem.java from"),
        (b"// big\n" * 1_500_000, "10 MB is too large for an answer"),
        (bytes(range(256)) * 20, "this is not text"),
        (b"\x89PNG\r\n\x1a\n\0\0", "this is not text"),
        (b"class A {\n  int a = (1;\n}\n", "line 2"),
    ],
    ids=["empty", "blank", "10 MB", "binary", "picture", "syntax"],
)
def test_a_file_that_is_no_code_is_refused_with_advice(real, capsys, content, said):
    (real / "exercises" / "exercise4" / JAVA).write_bytes(content)

    assert run_command(["exercise4", f"exercises/exercise4/{JAVA}"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert said in err
    assert err.count("\n") == 1


def test_an_empty_file_of_a_repository_is_got_back_with_git(real, capsys):
    (real / ".git").mkdir()
    (real / "exercises" / "exercise4" / JAVA).write_bytes(b"")

    assert run_command(["exercise4", f"exercises/exercise4/{JAVA}"]) == 2
    assert f"git checkout -- exercises/exercise4/{JAVA}" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("content", "code"),
    [
        ("class A {}\n", 1),
        ("// nothing but a comment\n", 1),
        ("class A { SysIdRoutine r = new SysIdRoutine(); }\n", 1),
        ("class A { SysIdRoutine r = new SysIdRoutine(null, null); }\n", 1),
        ("class A {" + "\n" * 50_000 + "}\n", 1),
        ('class Ä { String é = "\\u0000"; }\r\n', 1),
    ],
    ids=["bare", "comment", "no-arguments", "nulls", "long", "letters"],
)
def test_code_without_a_routine_gets_few_points_and_no_traceback(real, capsys, content, code):
    path = real / "A.java"
    path.write_text(content, "utf-8")

    assert run_command(["exercise4", "A.java", "--json"]) == code
    assert json.loads(capsys.readouterr().out)["score"] <= 2


def test_without_a_file_the_better_starter_is_graded_and_named(real, capsys):
    folder = real / "exercises" / "exercise4"
    solutions = ROOT / "solutions" / "exercise4"
    assert run_command(["4"]) == 1
    assert JAVA in capsys.readouterr().out.splitlines()[0]

    shutil.copy(solutions / PYTHON, folder)
    assert run_command(["4"]) == 0
    assert PYTHON in capsys.readouterr().out.splitlines()[0]

    shutil.copy(solutions / JAVA, folder)
    assert run_command(["4"]) == 0
    assert JAVA in capsys.readouterr().out.splitlines()[0]


def test_a_starter_with_a_syntax_error_is_not_hidden_by_the_untouched_one(real, capsys):
    path = real / "exercises" / "exercise4" / JAVA
    path.write_text(path.read_text("utf-8").replace("new TalonFX(1)", "new TalonFX(1"), "utf-8")

    assert run_command(["4"]) == 2
    assert JAVA in capsys.readouterr().err


LESSON = (ROOT / "tests" / "robotcode" / "DriveSubsystem.java").read_text("utf-8")


@pytest.mark.parametrize(
    ("step", "code", "score"), [("3.0", 1, 14), ("3.5", 0, 15)], ids=["example", "practice"]
)
def test_the_source_lesson_to_the_letter(real, capsys, step, code, score):
    (real / "DriveSubsystem.java").write_text(
        LESSON.replace("Volts.of(3.0)", f"Volts.of({step})"), "utf-8"
    )

    assert run_command(["4", "DriveSubsystem.java", "--json"]) == code
    result = json.loads(capsys.readouterr().out)
    wrong = [check for check in result["checks"] if check["status"] != "passed"]

    assert result["score"] == score
    assert [check["id"] for check in wrong] == ["step"] * (15 - score)
    for check in wrong:
        assert "3 V is an example in many" in check["hint"]
        assert "Volts.of(3.5)" in check["hint"]


@pytest.mark.parametrize(
    ("old", "new", "note"),
    [
        (
            "m_left.setVoltage(voltage.in(Volts))",
            "m_left.setControl(new VoltageOut(voltage.in(Volts)))",
            "setVoltage() sends a VoltageOut, too",
        ),
        ("Seconds.of(10)", "null", "a default may change"),
    ],
)
def test_what_is_right_in_another_way_passes_with_a_note(real, capsys, old, new, note):
    text = (ROOT / "solutions" / "exercise4" / JAVA).read_text("utf-8")
    assert old in text
    imported = "import com.ctre.phoenix6.controls.VoltageOut;\nimport com.ctre"
    text = text.replace(old, new).replace("import com.ctre", imported, 1)
    (real / "Mine.java").write_text(text, "utf-8")

    assert run_command(["4", "Mine.java"]) == 0
    assert note in " ".join(capsys.readouterr().out.split())


OUT_OF_SIGHT = [
    (JAVA, "drive", [("m_right.setVoltage(voltage.in(Volts))", "Team.send(m_right, voltage)")]),
    (PYTHON, "drive", [("self.right.setVoltage(voltage)", "team.send(self.right, voltage)")]),
    (
        JAVA,
        "log",
        [
            (".linearVelocity(MetersPerSecond.of(getMetersPerSecond(m_right)))", ""),
            ('log.motor("left")', 'Team.finish(log);\n    log.motor("left")'),
        ],
    ),
]


@pytest.mark.parametrize(("name", "check", "changes"), OUT_OF_SIGHT)
def test_what_may_happen_out_of_sight_is_asked_about(real, capsys, name, check, changes):
    text = (ROOT / "solutions" / "exercise4" / name).read_text("utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    (real / name).write_text(text, "utf-8")

    assert run_command(["4", name, "--json"]) == 1
    checks = {one["id"]: one for one in json.loads(capsys.readouterr().out)["checks"]}

    assert checks[check]["status"] == "failed"
    assert "Write the callback in this class or" in checks[check]["hint"]
    assert checks[check]["misconception"] == ""


PROGRAM = """
from commands2.sysid import SysIdRoutine
from wpilib.sysid import SysIdRoutineLog
from example_subsystem import ExampleSubsystem

robot = ExampleSubsystem()
config = robot.routine.config
print(config.rampRate, config.stepVoltage, config.timeout)
for test in (robot.routine.quasistatic, robot.routine.dynamic):
    print(test(SysIdRoutine.Direction.kForward).getRequirements() == {robot})
robot.routine.mechanism.drive(3.0)
print(round(robot.left.getVoltage(), 1), round(robot.right.getVoltage(), 1))
robot.routine.mechanism.log(SysIdRoutineLog("drive"))
"""


@pytest.mark.robot
def test_the_python_solution_runs_on_wpilibs_own_routine(tmp_path):
    pytest.importorskip("commands2")
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT / "solutions" / "exercise4")},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )

    assert done.returncode == 0, done.stderr
    said = [line for line in done.stdout.splitlines() if not line.startswith("DataLog:")]
    assert said == ["0.5 3.5 10.0", "True", "True", "3.0 3.0"]


SOLUTIONS = {
    name: (ROOT / "solutions" / "exercise4" / name).read_text("utf-8") for name in (JAVA, PYTHON)
}


@pytest.fixture
def only_read(monkeypatch):
    """Runs nothing: a process for each of a hundred files would take long."""
    monkeypatch.setattr(bench, "is_robotpy_installed", lambda: False)


@given(
    name=st.sampled_from(sorted(SOLUTIONS)),
    begin=st.integers(0, 2500),
    length=st.integers(1, 200),
    put=st.sampled_from(["", "null", "None", "(", "})", "m_left", "0", ".times(2)", "λ"]),
)
@settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@pytest.mark.usefixtures("only_read")
def test_whatever_is_cut_out_of_code_our_checks_do_not_break(tmp_path, name, begin, length, put):
    text = SOLUTIONS[name]
    path = tmp_path / name
    path.write_text(text[:begin] + put + text[begin + length :], "utf-8")
    result = EXERCISE.grade(path, student="ann")

    assert "error" not in {check.status for check in result.checks}
    assert 0 <= result.score <= result.max_score == 15


SENT = "m_left.setVoltage(voltage.in(Volts));"
HELPER = "  private double getMeters("
FAR = "m_left.getPosition().getValueAsDouble() > 90"
PRINTS = "  @Override\n  public void periodic() {\n    System.out.println(m_left);\n  }\n"
RIGHT_TOO = {
    "bounds that no test reaches": (
        SENT,
        "m_left.setVoltage(Math.max(-12.0, Math.min(voltage.in(Volts), 12.0)));",
    ),
    "a condition without the voltage": (SENT, f"if (m_left.isConnected()) {{ {SENT} }}"),
    "a stop at the end of a way": (SENT, f"{SENT} if ({FAR}) {{ m_left.stopMotor(); }}"),
    "a periodic() that moves nothing": (HELPER, f"{PRINTS}\n{HELPER}"),
}


@pytest.mark.parametrize("case", RIGHT_TOO)
def test_guards_that_leave_the_voltage_alone_lose_nothing(case, tmp_path):
    old, new = RIGHT_TOO[case]
    text = SOLUTIONS[JAVA]
    assert old in text
    (tmp_path / JAVA).write_text(text.replace(old, new, 1), "utf-8")
    grade = find_exercise("exercise4", ROOT).grade(tmp_path / JAVA, student="ann")

    assert {one.id: one.seen for one in grade.checks if one.status != "passed"} == {}


LOST = [
    "{ m_routine = null; }",
    "public ExampleSubsystem() { m_routine = null; }",
    "public ExampleSubsystem() { this.m_routine = null; }",
    "public ExampleSubsystem() { clean(); }\n  private void clean() { m_routine = null; }",
]
KEPT = [
    "public void close() { m_routine = null; }",
    "public ExampleSubsystem() { m_other = null; }\n  private Object m_other;",
]


@pytest.mark.parametrize(("more", "right"), [(m, False) for m in LOST] + [(m, True) for m in KEPT])
def test_a_routine_that_is_set_to_null_again_is_lost(tmp_path, more, right):
    text = (ROOT / "solutions" / "exercise4" / JAVA).read_text("utf-8")
    text = text.replace("private final SysIdRoutine", "private SysIdRoutine")
    (tmp_path / JAVA).write_text(text.rstrip("}\n") + f"  }}\n\n  {more}\n}}\n", "utf-8")
    grade = EXERCISE.grade(tmp_path / JAVA, student="ann", run=False)
    found = {one.id: one for one in grade.checks}["assembled"]

    assert (grade.score == grade.max_score) is (found.status == "passed") is right
    assert right or "sets the field of the SysIdRoutine to null" in found.seen


def test_a_field_that_is_empty_until_the_routine_is_made_is_right(tmp_path):
    text = (ROOT / "solutions" / "exercise4" / PYTHON).read_text("utf-8")
    made = "        self.routine = SysIdRoutine("
    assert made in text
    for name, changed, right in (
        ("before", text.replace(made, f"        self.routine = None\n{made}"), True),
        (
            "after",
            text.replace("    def drive(", "        self.routine = None\n\n    def drive("),
            False,
        ),
    ):
        (tmp_path / name).mkdir()
        (tmp_path / name / PYTHON).write_text(changed, "utf-8")
        grade = EXERCISE.grade(tmp_path / name / PYTHON, student="ann", run=False)

        assert (grade.score == grade.max_score) is right


def graded_program(tmp_path, name, file):
    """The checks of exercise 4 on a program of the corpus, by their ids."""
    program = tmp_path / name
    shutil.copytree(whole_corpus() / "swerve" / name, program)
    (found,) = program.rglob(file)
    return {one.id: one for one in EXERCISE.grade(found, student="ann").checks}


def test_steering_that_a_loop_holds_straight_is_no_mistake(tmp_path):
    """AdvantageKit's template: the voltage goes through an interface to the drive motors."""
    found = graded_program(tmp_path, "advantagekit_template", "Drive.java")

    assert found["drive"].status == found["open-loop"].status == "passed"


@pytest.mark.parametrize(
    ("program", "said"),
    [
        ("advantagekit_template_torque", "TorqueCurrentFOC"),
        ("advantagekit_duty_on_one", "cannot see what modules[i].io gets"),
        ("advantagekit_simulated_only", "cannot see what modules[i].io gets"),
    ],
)
def test_where_no_voltage_is_sure_to_reach_the_wheels_it_is_said_or_asked(tmp_path, program, said):
    found = graded_program(tmp_path, program, "Drive.java")

    assert found["drive"].status == found["open-loop"].status == "failed"
    assert said in found["drive"].seen
    assert "line 0" not in found["drive"].seen
