"""Exercise 5: what each guard, decorator, button and comment does is seen by pressing it."""

from functools import cache

import pytest
from places import ROOT

from grader.exercise.exercise import Exercise

pytestmark = pytest.mark.slow

EXERCISE = Exercise("exercise5", ROOT / "exercises" / "exercise5")
JAVA, PYTHON = "RobotContainer.java", "robotcontainer.py"
IMPORTS = """import edu.wpi.first.wpilibj.*;
import edu.wpi.first.wpilibj.smartdashboard.*;
import edu.wpi.first.wpilibj2.command.*;
import edu.wpi.first.wpilibj2.command.button.*;
import com.ctre.phoenix6.hardware.TalonFX;
"""
GUARD = ".and(testing)"
LOGGED = "org.littletonrobotics.junction.networktables.LoggedNetworkBoolean"
MADE = "return m_routine.quasistatic(direction)"


@cache
def solution(name):
    return (ROOT / "solutions" / "exercise5" / name).read_text("utf-8")


def graded(tmp_path, *changes, name=JAVA):
    """The checks of the solution with parts replaced, by their names."""
    text = solution(name)
    if name == JAVA:
        text = text.replace("import com.ctre.phoenix6.hardware.TalonFX;\n", IMPORTS)
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    (tmp_path / name).write_text(text, "utf-8")
    return {one.id: one for one in EXERCISE.grade(tmp_path / name, student="ann").checks}


GUARDS = {  # what takes the place of test mode, and whether a match never brings it
    "RobotModeTriggers.test()": True,
    "() -> !(!DriverStation.isTest())": True,
    "() -> DriverStation.isTest() ? true : false": True,
    "RobotModeTriggers.test().negate().negate()": True,
    "() -> !DriverStation.isFMSAttached()": True,
    "m_driverController.back()": True,
    "m_driverController.leftTrigger()": True,
    "RobotModeTriggers.test().debounce(0.1)": True,
    "m_driverController.start().or(m_driverController.back())": True,
    '() -> SmartDashboard.getBoolean("SysId", false)': True,
    f'new {LOGGED}("SysId", false)': True,
    f'new {LOGGED}("SysId", true)': False,
    'new NetworkButton("Pit", "SysId")': True,
    '() -> SmartDashboard.getBoolean("SysId", true)': False,
    "() -> true": False,
    "() -> DriverStation.isTest() || true": False,
    "DriverStation::isEnabled": False,
    "DriverStation::isFMSAttached": False,
    "RobotModeTriggers.teleop()": False,
    "() -> DriverStation.getMatchTime() < 20": False,
    "() -> DriverStation.getAlliance().get() == DriverStation.Alliance.Red": False,
    "() -> RobotController.getBatteryVoltage() > 10": False,
    "() -> Timer.getFPGATimestamp() > 1": False,
    "m_driverController.leftTrigger(-0.5)": False,
    "m_driverController.start().negate()": False,
    "RobotBase::isReal": False,
}


@pytest.mark.parametrize("guard", GUARDS)
def test_guard_counts_if_no_state_of_a_match_opens_it(guard, tmp_path):
    found = graded(tmp_path, (GUARD, f".and({guard})"))["guard"]

    assert (found.status == "passed") is GUARDS[guard], found.seen


DECORATORS = {  # what follows the command of a test, and whether it can still be held to its end
    'withName("test")': True,
    "finallyDo(() -> System.out.println())": True,
    "beforeStarting(() -> System.out.println())": True,
    "withTimeout(12)": True,
    "unless(() -> false)": True,
    "raceWith(Commands.waitSeconds(20))": True,
    'andThen(Commands.print("done"))': True,
    "asProxy()": True,
    "unless(() -> true)": False,
    "beforeStarting(Commands.idle())": False,
    "until(() -> true)": False,
    "withTimeout(0.1)": False,
    "repeatedly()": False,
    "andThen(turn(() -> 0.3))": False,
}


@pytest.mark.parametrize("decorator", DECORATORS)
def test_test_that_a_decorator_delays_cuts_or_repeats_is_not_held(decorator, tmp_path):
    found = graded(tmp_path, (MADE, f"{MADE}.{decorator}"))["held"]

    assert (found.status == "passed") is DECORATORS[decorator], found.seen


STARTED = {  # what else starts a test
    "a default command": "m_subsystem.setDefaultCommand(m_subsystem.sysIdDynamic(FORWARD));",
    "the constructor": (
        "CommandScheduler.getInstance().schedule(m_subsystem.sysIdDynamic(FORWARD));"
    ),
    "releasing": "m_driverController.a().onFalse(m_subsystem.sysIdDynamic(FORWARD));",
}


@pytest.mark.parametrize("case", STARTED)
def test_test_without_a_held_button_loses_points(case, tmp_path):
    line = STARTED[case].replace("FORWARD", "SysIdRoutine.Direction.kForward")
    found = graded(
        tmp_path, ("    // --- end\n  }\n}\n", f"    // --- end\n    {line}\n  }}\n}}\n")
    )

    assert {found["held"].status, found["guard"].status} != {"passed"}


def test_autonomous_command_that_is_a_test_is_reported(tmp_path):
    method = (
        "  public Command getAutonomousCommand() {\n"
        "    return m_subsystem.sysIdDynamic(SysIdRoutine.Direction.kForward);\n  }\n"
    )
    found = graded(
        tmp_path, ("  private void configureBindings", f"{method}  private void configureBindings")
    )

    assert "autonomous runs dynamic forward" in found["guard"].seen


def test_button_on_a_dashboard_that_starts_a_test_is_reported(tmp_path):
    bound = "m_driverController.a().and(testing).whileTrue("
    found = graded(tmp_path, (bound, 'SmartDashboard.putData("Test",'))

    assert "a dashboard starts quasistatic forward" in str([one.seen for one in found.values()])


CONTROLLERS = {  # how a second controller is made, and whether it guards
    "CommandXboxController m_tests = new CommandXboxController(1);": True,
    "CommandXboxController m_tests = new CommandXboxController(0);": False,
    "CommandXboxController m_tests = m_driverController;": False,
}


@pytest.mark.parametrize("made", CONTROLLERS)
def test_controller_for_tests_only_is_a_guard(made, tmp_path):
    field = "private final CommandXboxController m_driverController = new CommandXboxController(0);"
    found = graded(
        tmp_path,
        (field, f"{field}\n  private final {made}"),
        (GUARD, ""),
        *((f"m_driverController.{key}()", f"m_tests.{key}()") for key in "abxy"),
    )["guard"]

    assert (found.status == "passed") is CONTROLLERS[made], found.seen


NAMED = {  # how a button is asked for, and how the feedback names it
    "a()": "A button (a())",
    "button(7)": "Back button (back())",
    "leftTrigger()": "LeftTrigger (leftTrigger())",
    "button(11)": "button 11",
}


@pytest.mark.parametrize(
    ("name", "guard", "controller"),
    [(JAVA, GUARD, "m_driverController"), (PYTHON, ".and_(testing)", "self.driver")],
)
@pytest.mark.parametrize("button", NAMED)
def test_button_is_named_as_robot_code_names_it(button, name, guard, controller, tmp_path):
    asked = (f"{controller}.a()", f"{controller}.{button}")
    found = graded(tmp_path, (guard, ""), asked, name=name)["guard"]

    assert f"{NAMED[button]} of the controller at port 0 alone starts" in found.seen


def test_comment_is_read_in_the_file_of_the_binding_only(tmp_path):
    container, mark, subsystem = solution(JAVA).partition("/** One motor, and a routine")
    imports = container[: container.index("/** The robot's parts")]
    other = imports + mark + subsystem
    asked = other[: other.index(MADE)].count("\n")
    steps = "return runOnce(() -> {}).andThen(\n        m_routine.quasistatic(direction))"
    other = other.replace(MADE, steps)
    wrong = container[: container.index("// Dynamic, forward")].count("\n")
    (tmp_path / JAVA).write_text("\n" * (asked + 1) + container, "utf-8")
    (tmp_path / "ExampleSubsystem.java").write_text("\n" * (wrong + 2) + other, "utf-8")
    found = {one.id: one for one in EXERCISE.grade(tmp_path / JAVA, student="ann").checks}

    assert found["comments"].status == "passed", found["comments"].seen


def test_comment_at_the_binding_counts_wherever_its_command_is_made(tmp_path):
    whole = "m_subsystem.sysIdDynamic(SysIdRoutine.Direction.kForward)"
    scheduled = f"Commands.runOnce(() -> {whole}.schedule())"
    heading = f"// the tests\n    Command step = {whole};\n\n    Trigger testing ="

    apart = graded(tmp_path, (f"{whole});", "step);"), ("Trigger testing =", heading))
    indirect = graded(tmp_path, (f"{whole});", f"{scheduled});"))

    assert apart["comments"].status == indirect["comments"].status == "passed"
    assert "only start another command" in indirect["held"].hint


def test_method_that_takes_its_direction_by_name_makes_tests(tmp_path):
    found = graded(
        tmp_path,
        ("(self, direction:", "(self, *, direction:"),
        ("(SysIdRoutine.Direction.k", "(direction=SysIdRoutine.Direction.k"),
        name=PYTHON,
    )

    assert {one.status for one in found.values()} == {"passed"}


def test_trigger_that_binds_nothing_is_not_called_asked_only_once(tmp_path):
    checks = graded(tmp_path, ("m_subsystem.", "m_misspelt."))

    assert not any("only once" in one.seen for one in checks.values())


def test_neighbour_that_does_not_parse_is_named_as_the_cause(tmp_path):
    top, _, subsystem = solution(JAVA).partition("/** One motor")
    imports = top.partition("/**")[0]
    broken = subsystem.replace("new TalonFX(1);", "new TalonFX(1)")
    assert broken != subsystem
    (tmp_path / "ExampleSubsystem.java").write_text(f"{imports}/** One motor{broken}", "utf-8")
    (tmp_path / JAVA).write_text(top, "utf-8")

    checks = EXERCISE.grade(tmp_path / JAVA, student="ann").checks

    assert "of ExampleSubsystem.java: a ';' is missing" in checks[0].seen
    assert not any("no file here" in one.seen for one in checks)


def test_feedback_asks_for_a_missing_file_and_does_not_call_it_wrong(tmp_path):
    text = solution(JAVA)
    container = text.partition("/** One motor, and a routine")[0]
    container = container.replace(
        "package frc.robot;", "package frc.robot;\nimport frc.robot.subsystems.ExampleSubsystem;"
    )
    (tmp_path / JAVA).write_text(container, "utf-8")
    found = {one.id: one for one in EXERCISE.grade(tmp_path / JAVA, student="ann").checks}

    assert "ExampleSubsystem" in found["factories"].seen
    assert "same folder" in found["factories"].hint


@pytest.mark.parametrize(
    "text",
    [
        "class A { void a() { a(); b(); } void b() { a(); } }\n",
        "class A { Command c = c; void a() { m.a().whileTrue(c); } }\n",
        "class A { A() { while (true) { } } }\n",
        "class A { A() { new A(); } }\n",
        "class A { A() { " + "if (b) { " * 90 + "}" * 90 + " } }\n",
    ],
    ids=["circle", "itself", "endless", "recursion", "deep"],
)
def test_meaningless_code_ends_and_earns_nothing(text, tmp_path):
    (tmp_path / JAVA).write_text(text, "utf-8")
    grade = EXERCISE.grade(tmp_path / JAVA, student="ann")

    assert grade.score == 0
    assert "error" not in {one.status for one in grade.checks}
