"""Robot code that the course shows: javac compiles it against stubs, RobotPy runs it in simulation.

Where javac and the grader's own compile check disagree on a file of the corpus, the table
``DISAGREED`` says why. A file that javac takes and the grader refuses has no place in it.
"""

import math
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from authored import load
from java_compiler import STUBS, JavaError, JavaProgram, compile_java
from robot_corpus import whole_corpus
from robot_mistakes import needs_robot
from test_commands_v3 import BINDINGS, RIGHT, RUN_OF_V2
from test_robot_code_snippet import found

from grader.robotcode import bench
from grader.robotcode.bench import RunOutcome
from grader.robotcode.compiling import find_compile_errors
from grader.robotcode.facts import ParseProblem
from grader.robotcode.files import Files
from grader.robotcode.symbol_table import SymbolTable
from sim.report.robot_code_snippet import write_robot_code

ROOT = Path(__file__).resolve().parents[1]
CORPUS = whole_corpus()
# A lesson's block that is no whole file, by a line it contains, and what a file of it looks like.
IMPORTS = """package frc.robot;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.DriverStation;
import edu.wpi.first.wpilibj2.command.Command;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.button.CommandXboxController;
import edu.wpi.first.wpilibj2.command.button.Trigger;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine.Direction;
"""
TESTS = """
  public Command sysIdQuasistatic(Direction direction) {
    return m_routine.quasistatic(direction);
  }

  public Command sysIdDynamic(Direction direction) {
    return m_routine.dynamic(direction);
  }
"""
LOOP = """
class Lift {{
  private final ElevatorFeedforward ff = new ElevatorFeedforward(0.2, 0.9, 2.0, 0.1);
  private final {controller}

  void loop({given}) {{
@block  }}

  void setVoltage(double volts) {{}}
}}
"""
FEEDBACK = "package frc.robot;\n\nimport edu.wpi.first.math.controller.*;\n"
FRAMES = {
    "pid.calculate(measured, v)": FEEDBACK
    + LOOP.format(
        controller="PIDController pid = new PIDController(5.0, 0.0, 0.0);",
        given="double v, double next, double measured",
    ),
    "pid.calculate(measured, goal)": FEEDBACK
    + "import edu.wpi.first.math.trajectory.TrapezoidProfile;\n"
    + LOOP.format(
        controller="ProfiledPIDController pid =\n"
        "      new ProfiledPIDController(5, 0, 0, new TrapezoidProfile.Constraints(1, 2));",
        given="double goal, double measured",
    ),
    "new ElevatorFeedforward(": "package frc.robot;\n\n"
    "import edu.wpi.first.math.controller.ElevatorFeedforward;\n\nclass Elevator {\n@block}\n",
    "m_sysIdController.a()": IMPORTS
    + """
class Container {
  private final CommandXboxController m_sysIdController = new CommandXboxController(2);
  private final Drive m_drive = new Drive();

  Container() {
@block  }
}

class Drive extends SubsystemBase {
  private final SysIdRoutine m_routine = null;
"""
    + TESTS
    + "}\n",
    "m_leader.set(voltage": IMPORTS
    + """
class Shooter extends SubsystemBase {
  private final TalonFX m_leader = new TalonFX(1);
  private Voltage m_lastRequest = Volts.zero();

@block"""
    + TESTS
    + """
  static class Container {
    private final CommandXboxController m_driver = new CommandXboxController(0);
    private final Shooter m_shooter = new Shooter();

    Container() {
@rest    }
  }
}
""",
}
USE = """class Use {{
  double volts(double angle, double velocity, double nextVelocity) {{
    return LeftDriveGains.{call};
  }}
}}
"""
SPLIT = "// in RobotContainer\n"  # in a block: what follows stands in another class

SHOOTER = {"kS": 0.2, "kV": 2.0, "kA": 0.3, "kP": 1.0}
GIVEN = """[analyzer]
analysis = "{analysis}"
units = "Rotations"
kS = 0.2
kG = 0.4
kV = 2.0
kA = 0.3
kP = 1.5

[robot]
units = "Radians"
loop_output = "duty cycle"

[motor_controller]
gear_ratio = 10.0
"""


@dataclass(frozen=True)
class Compiled:
    """Everything that was compiled, and what javac said of it."""

    programs: dict[str, JavaProgram]
    errors: dict[str, list[JavaError]]

    def of_file(self, path: Path) -> list[JavaError]:
        """The errors in one file."""
        return [one for errors in self.errors.values() for one in errors if one.file == path]


def texts() -> Iterator[tuple[str, int, dict[str, str]]]:
    """What stands in no file of its own: name, season, and file names with their texts."""
    blocks = re.findall(
        r"^```java\n(.*?)^```",
        "".join(
            re.sub(r"^# ?", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
            for path in sorted((ROOT / "lessons").glob("*.py"))
        ),
        re.MULTILINE | re.DOTALL,
    )
    for number, block in enumerate(blocks):
        if block.startswith("package"):
            (name,) = re.findall(r"^public class (\w+)", block, re.MULTILINE)
            yield f"lesson block {number}", 2026, {f"{name}.java": block}
            continue
        (frame,) = (frame for holds, frame in FRAMES.items() if holds in block)
        first, _, rest = block.partition(SPLIT)
        text = frame.replace("@block", first).replace("@rest", rest)
        yield f"lesson block {number}", 2026, {"Framed.java": text}

    practice = load(ROOT / "solutions" / "practice" / "solve.py")
    files = practice.fill_in_code(ROOT / "exercises" / "practice", SHOOTER, "m")
    yield (
        "answer to practice",
        2026,
        {name: text for name, text in files.items() if name.endswith(".java")},
    )
    for season in (2026, 2027):
        for type_ in ("simple", "elevator", "arm"):
            text = write_robot_code(found(type_), language="java", season=season, name="left drive")
            (call,) = re.findall(r"^\s*// Volts: (.*)$", text, re.MULTILINE)
            named = {"LeftDriveGains.java": text, "Use.java": USE.format(call=call)}
            yield f"sysid fit --paste java, {type_}, {season}", season, named


def collect(folder: Path) -> dict[str, JavaProgram]:
    """Every program to compile, by its name; texts are written into ``folder``."""
    programs: dict[str, JavaProgram] = {}
    exercise10 = load(ROOT / "solutions" / "exercise10" / "solve.py")
    more = []
    for analysis in ("Simple", "Elevator", "Arm"):
        data = folder / "given" / analysis
        data.mkdir(parents=True)
        (data / "given.toml").write_text(GIVEN.format(analysis=analysis), encoding="utf-8")
        answer = exercise10.solve(ROOT / "exercises" / "exercise10", data)["ExampleMechanism.java"]
        named = {"ExampleMechanism.java": answer}
        more.append((f"answer to exercise10, {analysis}", 2026, named))
    more += [
        (f"v3, {style}", 2027, {"ExampleSubsystem.java": text}) for style, text in RIGHT.items()
    ]
    loop = RIGHT["as its documentation has it"].replace(
        "  private void drive(", RUN_OF_V2 + "  private void drive("
    )
    more.append(("planted: a loop without a coroutine", 2027, {"ExampleSubsystem.java": loop}))
    more.append(("v3, buttons", 2027, {"RobotContainer.java": BINDINGS}))
    more += [(name, 2026, {file: text}) for name, (file, text) in planted().items()]
    for number, (name, season, files) in enumerate((*texts(), *more)):
        place = folder / f"text{number}"
        place.mkdir()
        for file, text in files.items():
            (place / file).write_text(text, encoding="utf-8")
        programs[name] = JavaProgram(tuple(sorted(place.iterdir())), season)
    for top in ("solutions", "exercises"):
        for path in sorted((ROOT / top).glob("*/*.java")):
            together = sorted(path.parent.glob("*.java")) if path.parent.name == "practice" else ()
            name = path.relative_to(ROOT).as_posix()
            programs[name] = JavaProgram(tuple(together) or (path,))
    return programs | corpus_programs()


def corpus_programs() -> dict[str, JavaProgram]:
    """The corpus: files that belong together as one program, all others each for itself."""
    programs = {}
    for path in sorted(CORPUS.rglob("*.java")):
        relative = path.relative_to(CORPUS)
        if relative.parts[0] == "broken":
            continue
        text = path.read_text(encoding="utf-8")
        season = 2027 if "org.wpilib." in text else 2026
        group = next((one for one in TOGETHER if relative.as_posix().startswith(f"{one}/")), "")
        files = sorted((CORPUS / group).rglob("*.java")) if group else [path]
        programs[group or relative.as_posix()] = JavaProgram(tuple(files), season)
    return programs


# Files of the corpus that javac refuses and the grader does not, because what they lack is out of
# sight for it: what javac misses, and why.
OUT_OF_SIGHT = {
    "PhoenixElevator.java": "MotorAlignmentValue",  # Phoenix 6 of 2025, where it was a boolean
    "advantagekit/subsystems/flywheel/Flywheel.java": "AutoLogged",  # written by AdvantageKit
    "advantagekit/subsystems/flywheel/FlywheelIO.java": "AutoLog",  # ... from this annotation
    "advantagekit/subsystems/flywheel/Logged.java": "AutoLogged",
    "phoenix/CommandSwerveDrivetrain.java": "TunerConstants",  # written by CTRE's generator
    "phoenix/OldTalon.java": "com.ctre.phoenix.motorcontrol",  # Phoenix 5
    "rev/CanShooter2024.java": "CANSpark",  # WPILib and REVLib of 2024
    "swerve/ctre/SwerveRotation.java": "TunerConstants",
    "swerve/ctre/SwerveSteer.java": "TunerConstants",
    "swerve/ctre/SwerveTranslation2024.java": "phoenix6.mechanisms",  # Phoenix 6 of 2024
    "swerve/ctre_season_2027/SwerveStraight2027.java": "TunerConstants",
    "swerve/yagsl/CenteredModules.java": "swervelib",  # YAGSL
    "swerve/yagsl/SwerveSubsystem.java": "swervelib",
    "wpilib/Season2027Drive.java": "getDutyCycle",  # getThrottle, in an early alpha
    "wpilib/ThirdPartyFactory.java": "swervelib",
    "wpilib/WrongSubsystem.java": "frc.robot.subsystems",  # a class of the same robot
}
TOGETHER = (
    "advantagekit",
    *(f"swerve/{one.name}" for one in sorted((CORPUS / "swerve").glob("advantagekit*"))),
    "team",
    "teams",
    "wpilib/split",
)


@pytest.fixture(scope="module")
def compiled(tmp_path_factory) -> Compiled:
    folder = tmp_path_factory.mktemp("java")
    programs = collect(folder)
    stubs = folder / "stubs"
    stubs.mkdir()
    found = compile_java(programs.values(), stubs)
    return Compiled(programs, dict(zip(programs, found, strict=True)))


@pytest.fixture(scope="module")
def judged(compiled) -> dict[str, tuple[list[JavaError], tuple[ParseProblem, ...]]]:
    """Files of the corpus that are whole: name -> what javac and what the grader says."""
    return {
        path.relative_to(CORPUS).as_posix(): (compiled.of_file(path), graders_errors(path))
        for program in corpus_programs().values()
        for path in program.files
        if re.search(r"^package ", path.read_text(encoding="utf-8"), re.MULTILINE)
    }


def test_the_grader_refuses_no_file_that_javac_takes(judged):
    assert len(judged) > 70
    assert sum(not javac for javac, _ in judged.values()) >= 49
    assert {name: grader for name, (javac, grader) in judged.items() if grader and not javac} == {}


def test_the_grader_takes_no_file_that_javac_refuses_but_for_what_is_out_of_its_sight(judged):
    taken = {name: javac for name, (javac, grader) in judged.items() if javac and not grader}

    assert sorted(taken) == sorted(OUT_OF_SIGHT)
    for name, errors in taken.items():
        assert OUT_OF_SIGHT[name] in errors[0].message, errors[0]


def test_right_answers_with_commands_v3_compile(compiled):
    found = {name: errors for name, errors in compiled.errors.items() if name.startswith("v3")}

    assert len(found) >= 20
    assert {name: errors for name, errors in found.items() if errors} == {}


def test_every_stub_names_its_source():
    for path in STUBS.rglob("season*/**/*.java"):
        first = path.read_text(encoding="utf-8").split("\n")[0]
        assert re.fullmatch(r"// Signatures of [\w ]+.*: \S+\.(java|html)", first), path


def test_all_robot_code_that_the_course_shows_compiles(compiled):
    corpus = corpus_programs()
    shown = {
        name: errors
        for name, errors in compiled.errors.items()
        if not name.startswith(("planted", "v3")) and name not in corpus
    }

    assert {name: errors for name, errors in shown.items() if errors} == {}
    assert sum(name.startswith("lesson") for name in shown) == 6
    assert sum(name.startswith("answer") for name in shown) == 4
    assert sum(name.startswith(("solutions", "exercises")) for name in shown) == 7


def planted() -> dict[str, tuple[str, str]]:
    """The right answer to exercise 4 with one mistake each: name -> file name, text."""
    right = (ROOT / "solutions" / "exercise4" / "ExampleSubsystem.java").read_text(encoding="utf-8")
    made = {}
    for mistake, (old, new) in MISTAKES.items():
        assert old in right, mistake
        made[f"planted: {mistake}"] = ("ExampleSubsystem.java", right.replace(old, new, 1))
    return made


MISTAKES = {
    "a misspelt method": (".linearVelocity(", ".linearVelosity("),
    "a missing import": ("import com.ctre.phoenix6.hardware.TalonFX;\n", ""),
    "a wrong type of argument": ("Volts.of(3.5)", "Seconds.of(3.5)"),
    "a number where a measure is wanted": ("Volts.of(3.5)", "3.5"),
    "an argument too few": ("this::drive, this::record, this)", "this::drive, this::record)"),
    "a signal where a number is wanted": (
        "Volts.of(m_left.getMotorVoltage().getValueAsDouble())",
        "Volts.of(m_left.getMotorVoltage())",
    ),
    "a number that is asked for its rate": ("Volts.of(0.5).per(Second)", "0.5.per(Second)"),
    "an object as a callback": ("this::record, this)", "this, this::record)"),
    "a current as a voltage": (
        "Volts.of(m_left.getMotorVoltage().getValueAsDouble())",
        "m_left.getStatorCurrent().getValue()",
    ),
    "a share as a voltage": (
        "Volts.of(m_left.getMotorVoltage().getValueAsDouble())",
        "m_left.getDutyCycle().getValue()",
    ),
    "a ramp without its time": ("Volts.of(0.5).per(Second)", "Volts.of(0.5)"),
    "a class as an interface": ("extends SubsystemBase", "implements SubsystemBase"),
    "an argument too many": ("voltage.in(Volts));", "voltage.in(Volts), 0);"),
}


@pytest.mark.parametrize("mistake", [*MISTAKES, "a loop without a coroutine"])
def test_javac_and_the_grader_refuse_a_planted_mistake(compiled, mistake):
    name = f"planted: {mistake}"
    (file,) = compiled.programs[name].files

    assert compiled.errors[name]
    assert graders_errors(file)


@pytest.mark.parametrize("share", ["get", "getThrottle"])
def test_the_share_that_a_talon_fx_gets_is_a_number(tmp_path, share):
    right = (ROOT / "solutions" / "exercise4" / "ExampleSubsystem.java").read_text(encoding="utf-8")
    old = "Volts.of(m_left.getMotorVoltage().getValueAsDouble())"
    assert old in right
    path = tmp_path / "ExampleSubsystem.java"
    new = f"Volts.of(m_left.{share}() * RobotController.getBatteryVoltage())"
    needed = "import edu.wpi.first.wpilibj.RobotController;\n"
    first = right.index("import ")
    text = (right[:first] + needed + right[first:]).replace(old, new)
    path.write_text(text, encoding="utf-8")

    assert not [one for one in graders_errors(path) if "signal" in one.message]


def graders_errors(path: Path) -> tuple[ParseProblem, ...]:
    """What the grader's own compile check says of a file, whatever the file holds."""
    return find_compile_errors(SymbolTable(Files(path)))


@needs_robot
def test_the_python_of_the_answer_to_practice_runs_in_simulation(tmp_path):
    practice = load(ROOT / "solutions" / "practice" / "solve.py")
    files = practice.fill_in_code(ROOT / "exercises" / "practice", SHOOTER, "m")
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")

    ran = bench.run_sysid_routine(tmp_path / "example_subsystem.py", "ExampleSubsystem")
    pressed = bench.press_buttons(tmp_path / "robotcontainer.py", "RobotContainer")

    assert ran.outcome is RunOutcome.RAN, ran.said
    assert pressed.outcome is RunOutcome.RAN, pressed.said
    tests = {one.tests for one in pressed.presses if one.test_mode}
    assert tests == {
        (f"{test}-{direction}",)
        for test in ("quasistatic", "dynamic")
        for direction in ("forward", "reverse")
    }
    assert not any(one.tests for one in pressed.presses if not one.test_mode)


@needs_robot
@pytest.mark.parametrize("analysis", ["Simple", "Elevator", "Arm"])
def test_the_python_of_the_answer_to_exercise_10_runs_with_wpilib(tmp_path, analysis):
    solve = load(ROOT / "solutions" / "exercise10" / "solve.py").solve
    (tmp_path / "given.toml").write_text(GIVEN.format(analysis=analysis), encoding="utf-8")
    text = solve(ROOT / "exercises" / "exercise10", tmp_path)["example_mechanism.py"]
    arguments = "0.0, 2.0, 2.0" if analysis == "Arm" else "2.0, 2.0"
    use = f"print(ExampleMechanism().feedforward.calculate({arguments}))\n"
    program = tmp_path / "example_mechanism.py"
    program.write_text(f"{text}\n\n{use}", encoding="utf-8")

    done = subprocess.run(
        [sys.executable, str(program)], capture_output=True, encoding="utf-8", check=False
    )

    assert done.returncode == 0, done.stderr
    gravity = 0.0 if analysis == "Simple" else 0.4
    kv = 2.0 / (2 * math.pi)  # shown in rotations, used in radians
    assert float(done.stdout.split()[-1]) == pytest.approx(0.2 + gravity + kv * 2.0)
