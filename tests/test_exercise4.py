"""Exercise 4: files of all kinds, and what is right in more than one way."""

import json
import os
import re
import shutil
import subprocess
import sys

import pytest
from places import ROOT
from robot_corpus import whole_corpus

from grader.cli import run_command
from grader.exercise.exercise import Exercise
from grader.robotcode.checks.causes import FAULTS

JAVA, PYTHON = "ExampleSubsystem.java", "example_subsystem.py"
EXERCISE = Exercise("exercise4", ROOT / "exercises" / "exercise4")


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
def test_a_file_that_is_no_code_is_refused_with_advice(all_exercises, capsys, content, said):
    (all_exercises / "exercises" / "exercise4" / JAVA).write_bytes(content)

    assert run_command(["exercise4", f"exercises/exercise4/{JAVA}"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert said in err
    assert err.count("\n") == 1


def test_without_a_file_the_better_starter_is_graded_and_named(all_exercises, capsys):
    folder = all_exercises / "exercises" / "exercise4"
    solutions = ROOT / "solutions" / "exercise4"
    assert run_command(["4"]) == 1
    assert JAVA in capsys.readouterr().out.splitlines()[0]

    shutil.copy(solutions / PYTHON, folder)
    assert run_command(["4"]) == 0
    assert PYTHON in capsys.readouterr().out.splitlines()[0]

    shutil.copy(solutions / JAVA, folder)
    assert run_command(["4"]) == 0
    assert JAVA in capsys.readouterr().out.splitlines()[0]


@pytest.mark.parametrize(
    ("old", "new", "wrong"),
    [
        ("rampRate=0.5, stepVoltage=3.5", "rampRate=3.5, stepVoltage=0.5", ["ramp", "step"]),
        ("timeout=10.0", "timeout=0.01", ["timeout"]),
        ("self.right.setVoltage(", "self.left.setVoltage(", ["drive"]),
        ("self.left_encoder.getRate()", "self.left_encoder.getDistance() / 0.02", ["log"]),
    ],
    ids=["a ramp beyond the battery", "no time to log", "a motor at rest", "no velocity"],
)
def test_a_mistake_fails_only_the_check_of_its_own_callback(tmp_path, old, new, wrong):
    right = (ROOT / "solutions" / "exercise4" / PYTHON).read_text("utf-8")
    assert old in right
    (tmp_path / PYTHON).write_text(right.replace(old, new), encoding="utf-8")

    grade = EXERCISE.grade(tmp_path / PYTHON, student="ada")

    assert [one.id for one in grade.checks if one.status == "failed"] == wrong


STYLES = (
    "advantagekit/subsystems/drive/Drive.java",
    "teams/ChainedConsumers.java",
    "teams/EnumFlywheels.java",
    "teams/WrappedModules.java",
    "teams/named_follower.py",
)


@pytest.mark.parametrize("name", STYLES)
def test_program_in_a_style_of_teams_earns_full_marks(name):
    result = EXERCISE.grade(whole_corpus() / name, student="ann")

    assert [check.seen for check in result.checks if check.status != "passed"] == []


LESSON = (ROOT / "tests" / "robotcode" / "DriveSubsystem.java").read_text("utf-8")


@pytest.mark.parametrize(
    ("step", "code", "score"), [("3.0", 1, 14), ("3.5", 0, 15)], ids=["example", "practice"]
)
def test_code_copied_from_the_source_lesson_gets_the_expected_score(
    all_exercises, capsys, step, code, score
):
    (all_exercises / "DriveSubsystem.java").write_text(
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
def test_unusual_but_right_code_passes_with_a_note(all_exercises, capsys, old, new, note):
    text = (ROOT / "solutions" / "exercise4" / JAVA).read_text("utf-8")
    assert old in text
    imported = "import com.ctre.phoenix6.controls.VoltageOut;\nimport com.ctre"
    text = text.replace(old, new).replace("import com.ctre", imported, 1)
    (all_exercises / "Mine.java").write_text(text, "utf-8")

    assert run_command(["4", "Mine.java"]) == 0
    assert note in " ".join(capsys.readouterr().out.split())


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


def graded(tmp_path, *changes):
    """The grade of the Java solution with parts replaced."""
    text = SOLUTIONS[JAVA]
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    (tmp_path / JAVA).write_text(text, "utf-8")
    return EXERCISE.grade(tmp_path / JAVA, student="ann")


SENT = "m_left.setVoltage(voltage.in(Volts));"
HELPER = "  private double getMeters("
PRINTS = "  @Override\n  public void periodic() {\n    System.out.println(m_left);\n  }\n"
RARE = """
  private enum Mode { IDLE { double volts() { return 0; } }; abstract double volts(); }
  private final java.util.Map<String, Double> m_counts = new java.util.HashMap<>();

  @Override
  public void periodic() {
    m_counts.merge("loops", Mode.IDLE.volts(), Double::sum);
    java.util.List<Integer> ids = new java.util.ArrayList<>(java.util.List.of(3, 1, 2));
    ids.sort(java.util.Comparator.reverseOrder());
    double[] speeds = {1.0, 2.0};
    System.arraycopy(speeds, 0, speeds, 1, 1);
    if (speeds[1] > m_counts.get("loops") + ids.get(0)) {
      System.out.println(ids);
    }
  }
"""
FIELD = "private final SysIdRoutine m_routine"
END = "    return motor.getVelocity().getValueAsDouble() * METERS_PER_ROTATION;\n  }\n"
RIGHT_TOO = {
    "bounds that no test reaches": (
        SENT,
        "m_left.setVoltage(Math.max(-12.0, Math.min(voltage.in(Volts), 12.0)));",
    ),
    "a condition without the voltage": (SENT, f"if (m_left.isConnected()) {{ {SENT} }}"),
    "a periodic() that moves nothing": (HELPER, f"{PRINTS}\n{HELPER}"),
    "a periodic() that computes what nobody knows": (HELPER, f"{RARE}\n{HELPER}"),
    "a method that would lose the routine, and that nobody calls": (
        END,
        f"{END}  public void close() {{ m_other = null; }}\n  private Object m_other;\n",
    ),
}


@pytest.mark.parametrize("case", RIGHT_TOO)
def test_code_that_leaves_the_voltage_alone_loses_nothing(case, tmp_path):
    grade = graded(tmp_path, RIGHT_TOO[case])

    assert {one.id: one.seen for one in grade.checks if one.status != "passed"} == {}


WRONG = {  # the change, the check that has to fail, and what its author is told
    "the voltage is held back below 2 V": (
        (SENT, f"if (voltage.in(Volts) < -2) return; {SENT}"),
        "drive",
        "quasistatic reverse",
    ),
    "a loop that never ends": (
        (SENT, f"while (m_left.getDeviceID() == 1) {{ }} {SENT}"),
        "drive",
        "hangs",
    ),
    "the log callback drives": (
        ('log.motor("left")', 'm_left.setVoltage(1); log.motor("left")'),
        "drive",
        "the log callback calls setVoltage()",
    ),
    "a constructor loses the routine again": (
        (
            FIELD,
            f"public ExampleSubsystem() {{ m_routine = null; }}\n  {FIELD.replace('final ', '')}",
        ),
        "routine",
        "nothing keeps the SysIdRoutine",
    ),
    "feet that are meters": (
        ("Meters.of(getMeters(m_left))", "edu.wpi.first.units.Units.Feet.of(getMeters(m_left))"),
        "units",
        "and by the task's own number it is 0.0472 m",
    ),
    "the position is set to zero in each loop": (
        ('log.motor("left")', 'm_left.setPosition(0); log.motor("left")'),
        "log",
        "left's position stays 0 while the motor turns",
    ),
    "a class of one's own that is weaker": (
        (
            "private final TalonFX m_left = new TalonFX(1);",
            (
                "private final TalonFX m_left = new TalonFX(1) {\n    @Override public void "
                "setVoltage(double volts) { super.setVoltage(volts / 2); }\n  };"
            ),
        ),
        "drive",
        "m_left gets",
    ),
    "the name of one side for the other": (
        ('log.motor("right")', 'log.motor("left")'),
        "log",
        "Is the name of the second one copied, too?",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_code_is_explained_by_what_the_robot_did(case, tmp_path):
    change, check, said = WRONG[case]
    found = {one.id: one for one in graded(tmp_path, change).checks}[check]

    assert found.status == "failed"
    assert said in f"{found.seen} {found.hint}"


OWN = ("ExampleSubsystem", "Mine")  # in a class of one's own the grader knows no mounting
LIMITS = (
    "new com.ctre.phoenix6.configs.SoftwareLimitSwitchConfigs().withForwardSoftLimitEnable(true)"
    ".withForwardSoftLimitThreshold(1)"
)


@pytest.mark.parametrize(
    "changes",
    [
        pytest.param(
            [OWN, (FIELD, f"{{ m_left.getConfigurator().apply({LIMITS}); }}\n  {FIELD}")],
            id="a limit of its travel stops a motor",
        ),
        pytest.param(
            [
                OWN,
                ("import com.ctre", "import frc.robot.Team;\nimport com.ctre"),
                ("Volts.of(0.5)", "Volts.of(Team.RAMP)"),
                ("m_right.setVoltage(voltage", "m_right.setVoltage(-voltage"),
            ],
            id="the other sign, and a ramp that nobody knows",
        ),
    ],
)
def test_call_into_an_unseen_class_is_not_called_wrong(changes, tmp_path):
    found = {one.id: one for one in graded(tmp_path, *changes).checks}["drive"]

    assert (found.status, found.seen) == ("passed", "")


def test_feedback_asks_for_the_missing_file_of_a_class(tmp_path):
    grade = graded(
        tmp_path,
        ("import com.ctre", "import frc.robot.Team;\nimport com.ctre"),
        (
            "m_right.setVoltage(voltage.in(Volts))",
            "m_right.setVoltage(Team.limit(voltage.in(Volts)))",
        ),
    )
    found = {one.id: one for one in grade.checks}["drive"]

    assert found.status == "failed"
    assert "the grader cannot know what voltage m_right gets" in found.seen
    assert found.misconception == ""


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


def test_torque_current_is_reported_as_no_voltage(tmp_path):
    found = graded_program(tmp_path, "advantagekit_template_torque", "Drive.java")

    assert found["drive"].status == found["open-loop"].status == "failed"
    assert "TorqueCurrentFOC" in found["drive"].seen


def test_corpus_of_whole_programs_is_judged_right(shared):
    """Programs in the styles of teams, made outside: a part of them in each run of the tests."""
    folder = shared / "data" / "robot-code"
    cases = json.loads((folder / "cases.json").read_text("utf-8"))
    wrong = []
    for case in [one for one in cases if one["exercise"] == "exercise4"][::10]:
        path = folder / case["kind"] / case["exercise"] / case["name"] / case["main"]
        grade = EXERCISE.grade(path, student="ann")
        if (grade.score == grade.max_score) is not (case["kind"] == "legal"):
            wrong.append(case["name"])

    assert wrong == []


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
def test_code_without_a_routine_gets_few_points_and_no_traceback(
    all_exercises, capsys, content, code
):
    path = all_exercises / "A.java"
    path.write_text(content, "utf-8")

    assert run_command(["exercise4", "A.java", "--json"]) == code
    assert json.loads(capsys.readouterr().out)["score"] <= 2


def test_each_fault_that_has_words_is_found_by_a_check_and_each_check_has_words():
    files = (ROOT / "grader" / "robotcode" / "checks").glob("*.py")
    text = "".join(one.read_text("utf-8") for one in files)

    assert [name for name in FAULTS if f'"{name}"' not in text] == []
    assert set(re.findall(r'\bfault\(\s*"(\w+)"', text)) <= FAULTS.keys()
