"""Exercise 5: bindings in many styles, and what is right in more than one way."""

import re
from pathlib import Path

import pytest
from binding_styles import ARM, FOUR, PLAIN, PYTHON_STYLES, STYLES, SUBSYSTEM, four, java, python

from grader.exercise import Exercise
from grader.robotcode.binding_facts import Hold
from grader.robotcode.bindings import read_bindings

ROOT = Path(__file__).resolve().parents[1]
EXERCISE = Exercise("exercise5", ROOT / "exercises" / "exercise5")
SOLUTIONS = ROOT / "solutions" / "exercise5"
JAVA, PYTHON = "RobotContainer.java", "robotcontainer.py"


@pytest.mark.parametrize("style", STYLES)
def test_four_bindings_in_java_are_read_in_many_styles(style, tmp_path):
    text, guard = STYLES[style]
    path = tmp_path / JAVA
    path.write_text(text, "utf-8")
    facts = read_bindings(path)

    assert [(t.kind, t.direction) for one in facts.bindings for t in one.tests] == FOUR
    assert {one.hold for one in facts.bindings} == {Hold.WHILE}
    assert len({one.trigger for one in facts.bindings} - {""}) == 4
    assert all(one.guards == (guard,) for one in facts.bindings)
    assert facts.unread == ()
    assert passed(path) >= {"factories", "held", "each-once", "guard"}


@pytest.mark.parametrize("style", PYTHON_STYLES)
def test_four_bindings_in_python_are_read_in_many_styles(style, tmp_path):
    body, guard = PYTHON_STYLES[style]
    path = tmp_path / PYTHON
    path.write_text(python(body), "utf-8")
    facts = read_bindings(path)

    assert [(t.kind, t.direction) for one in facts.bindings for t in one.tests] == FOUR
    assert len({one.trigger for one in facts.bindings} - {""}) == 4
    assert all(one.guards == (guard,) for one in facts.bindings)
    assert passed(path) >= {"factories", "held", "each-once", "guard"}


def checked(path):
    # Read only: most of these are parts of programs, which would not run.
    return {one.id: one for one in EXERCISE.grade(path, student="ann", run=False).checks}


def passed(path):
    return {name for name, one in checked(path).items() if one.status == "passed"}


def judged(tmp_path, text, *, name=JAVA):
    path = tmp_path / name
    path.write_text(text, "utf-8")
    return checked(path)


LESSON = """
public class RobotContainer {
  private final DriveSubsystem m_drive = new DriveSubsystem();
  private final CommandXboxController m_driverController = new CommandXboxController(0);
  private final CommandXboxController m_operatorController = new CommandXboxController(1);

  public RobotContainer() {
    m_drive.setDefaultCommand(m_drive.drive(m_driverController::getLeftY));
    configureButtonBindings();
  }

  private void configureButtonBindings() {
    // Quasistatic forward: ramps slowly, measures kS and kV.
    m_operatorController.a().whileTrue(m_drive.sysIdQuasistaticForward());
    // Quasistatic reverse: ramps slowly, measures static friction kS and kV backward.
    m_operatorController.b().whileTrue(m_drive.sysIdQuasistaticReverse());
    // Dynamic forward: a step, measures kA.
    m_operatorController.x().whileTrue(m_drive.sysIdDynamicForward());
    // Dynamic reverse: a step, measures kA backward.
    m_operatorController.y().whileTrue(m_drive.sysIdDynamicReverse());
  }
}
"""
DRIVE = ROOT / "tests" / "robotcode" / "DriveSubsystem.java"


def test_the_source_lesson_to_the_letter_gets_full_marks_with_its_subsystem_beside_it(tmp_path):
    (tmp_path / DRIVE.name).write_bytes(DRIVE.read_bytes())
    found = judged(tmp_path, LESSON)

    assert {name for name, one in found.items() if one.status != "passed"} == set()
    assert "Unplug that controller" in found["guard"].hint


def test_without_the_subsystem_it_asks_for_it_and_never_guesses(tmp_path, reads):
    found = judged(tmp_path, LESSON)

    reads(found["factories"].seen)
    reads(found["factories"].hint)
    assert found["factories"].points == 0
    assert found["held"].status == found["guard"].status == "passed"


FIRST = "m_arm.quasistatic(Direction.kForward)"
START = "m_driver.start()"


def test_a_robotpy_container_finds_its_subsystem_in_another_file(tmp_path):
    body = four("self.driver.{key}().and_(DriverStation.isTest)!")
    (tmp_path / "subsystems").mkdir()
    (tmp_path / "subsystems" / "arm.py").write_text(ARM, "utf-8")
    whole = python(body).replace(ARM, "from subsystems.arm import Arm\n")
    found = judged(tmp_path, whole, name=PYTHON)

    assert "class Arm" not in whole
    assert found["factories"].status == found["held"].status == "passed"


@pytest.mark.parametrize(
    ("change", "check", "points", "says"),
    [
        ((START, "m_driver.rightBumper()"), "held", 3, ""),
        (("whileTrue", "onTrue"), "held", 1, "Once started, the test runs to its"),
        ((f".and({START})", ""), "guard", 0, "Use something that never happens in a"),
        (("m_driver.b()", "other()"), "held", 3, ""),
        (
            (FIRST, "m_arm.quasistatic(pick())"),
            "each-once",
            0,
            "the grader cannot see the direction",
        ),
        ((FIRST, "tests[0]"), "held", 2.25, "the grader cannot see which test"),
        (
            (FIRST, f"{FIRST}.andThen(m_arm.dynamic(Direction.kForward))"),
            "each-once",
            0,
            "runs quasistatic forward and dynamic forward",
        ),
        (("public Command dynamic", "Command dynamic"), "factories", 1, "may not call dynamic"),
        ((START, "() -> true"), "guard", 0, "Use something that never happens in a"),
        ((START, "m_driver.start().negate()"), "guard", 0, "Use something that never happens in a"),
        ((START, "m_driver.start().or(m_driver.back())"), "guard", 2, ""),
        (
            (START, "RobotModeTriggers.disabled()"),
            "guard",
            0,
            "checks for another mode than test mode",
        ),
    ],
)
def test_what_is_not_right_is_told(tmp_path, change, check, points, says):
    text = java(PLAIN)
    assert change[0] in text
    found = judged(tmp_path, text.replace(*change))[check]

    assert (found.status == "passed") is (not says)
    assert found.points == points
    assert says in f"{found.seen} {found.hint}"


def test_a_method_that_makes_one_test_or_another_is_asked_about(tmp_path, reads):
    more = """def make(self, kind, way):
    if kind == "dynamic":
        return self.arm.dynamic(way)
    return self.arm.quasistatic(way)
"""
    body = four(
        "self.driver.{key}().and_(self.driver.start()).whileTrue("
        "self.make('{kind}', Direction.k{Way}))"
    )
    found = judged(tmp_path, python(body, more=more), name=PYTHON)

    reads(found["held"].seen)
    assert {found[name].status for name in ("each-once", "guard")} == {"not-reached"}


def test_a_controller_that_is_used_in_a_match_is_no_guard(tmp_path):
    bound = four("m_operator.{key}()!")
    apart = judged(tmp_path, java(bound))["guard"]
    shared = judged(tmp_path, java(bound + "\nm_operator.start().onTrue(m_arm.shoot());"))["guard"]

    assert apart.status == "passed"
    assert shared.status == "failed"
    assert "start() in line 13" in shared.hint


def test_the_only_controller_is_no_controller_of_its_own(tmp_path):
    bound = four("m_driver.{key}()!")

    assert judged(tmp_path, java(bound))["guard"].status == "failed"


def test_a_chooser_holds_no_button(tmp_path, reads):
    rows = four('m_chooser.addOption("{kind} {way}", m_arm.{kind}(Direction.k{Way}));')
    found = judged(tmp_path, java(rows))

    reads(found["held"].hint)
    assert 'addOption("quasistatic forward"' in found["held"].seen


@pytest.mark.parametrize(
    ("comment", "right"),
    [
        ("// Quasistatic forward: finds kS, kV", True),
        ("// slow ramp, gives static friction and velocity gain", True),
        ("/* The quasi-static test.\n * It measures friction. */", True),
        ("// ramps up slowly; KS and KV", True),
        ("// quasistatic test", False),
        ("// measures kV", False),
        ("// dynamic test: kA", False),
        ("// quasistatic: how much it accelerates", False),
        ("", False),
    ],
)
def test_a_comment_names_the_test_and_the_property(tmp_path, comment, right):
    line = PLAIN.splitlines()[0]
    rows = four("// {Kind}: kS, kV and kA\nm_driver.{key}().and(m_driver.start())!")
    rest = rows.split("\n", 2)[2]
    above = judged(tmp_path, java(f"{comment}\n{line}\n\n{rest}"))["comments"]
    behind = judged(tmp_path, java(f"{line} {comment}\n\n{rest}"))["comments"]

    assert (above.status == "passed", behind.status == "passed") == (right, right)
    assert above.points == behind.points == (2 if right else 1.5)


def test_two_slashes_in_a_text_are_no_comment(tmp_path, reads):
    line = 'System.out.println("// quasistatic: kS and kV");\n'
    found = judged(tmp_path, java(line + PLAIN))["comments"]

    reads(found.seen)


def test_robotpy_has_no_mode_triggers_and_says_so(tmp_path):
    body = four(
        "self.driver.{key}().and_(RobotModeTriggers.test()).whileTrue("
        "self.arm.{kind}(Direction.k{Way}))"
    )
    found = judged(tmp_path, python(body), name=PYTHON)["guard"]

    assert found.status == "passed"
    assert "DriverStation.isTest" in found.hint


@pytest.mark.parametrize("name", [JAVA, PYTHON])
def test_no_damage_to_a_file_brings_the_reader_down(tmp_path, name):
    """Every word of the solution taken out once, and the rest of the file cut off once."""
    text = (SOLUTIONS / name).read_text("utf-8")
    path = tmp_path / name
    words = [*re.finditer(r"\w+|[^\w\s]", text)]
    for found in words[1::7]:
        for broken in (text[: found.start()] + text[found.end() :], text[: found.start()]):
            path.write_text(broken + "\n", "utf-8")
            facts = read_bindings(path)

            assert facts.language == ("java" if name == JAVA else "python")


@pytest.mark.parametrize(
    "text",
    [
        "class A { void a() { a(); b(); } void b() { a(); } }\n",
        "class A { Command c = c; void a() { m.a().whileTrue(c); } }\n",
        "class A { void a(Trigger t) { a(t.and(t)); t.whileTrue(m.quasistatic(kForward)); } }\n",
        "class A { A() { " + "x()" + ".and(y())" * 90 + ".whileTrue(r.dynamic(kForward)); } }\n",
        "class A { A() { " + "if (b) { " * 90 + "}" * 90 + " } }\n",
    ],
    ids=["circle", "itself", "recursion", "chain", "deep"],
)
def test_code_that_leads_nowhere_ends(tmp_path, text):
    path = tmp_path / JAVA
    path.write_text(text, "utf-8")

    assert read_bindings(path).language == "java"


INVERTED = [
    "RobotModeTriggers.test().negate()",
    "() -> !DriverStation.isTest()",
    "new Trigger(() -> !DriverStation.isTestEnabled())",
    "() -> DriverStation.isTest() == false",
    "RobotModeTriggers.utility().negate()",
    "() -> !RobotState.isUtilityEnabled()",
    "() -> DriverStation.isTest() != true",
    "() -> DriverStation.isTest() ? false : true",
    "new Trigger(DriverStation::isTest).negate()",
    "new Trigger(() -> m_driver.getHID().getStartButton() && DriverStation.isTest()).negate()",
]


@pytest.mark.parametrize("guard", INVERTED)
def test_a_guard_that_asks_for_any_mode_but_test_mode_is_none(tmp_path, guard, reads):
    found = judged(tmp_path, java(PLAIN.replace(START, guard)))["guard"]

    assert (found.status, found.points) == ("failed", 0)
    reads(found.seen)
    reads(found.hint)


@pytest.mark.parametrize(
    "guard",
    [
        "Trigger(DriverStation.isTest).negate()",
        "~Trigger(DriverStation.isTest)",
        "lambda: not DriverStation.isTest()",
        "Trigger(lambda: not DriverStation.isTest())",
        "lambda: DriverStation.isTest() is False",
        "lambda: DriverStation.isTest() == False",
        "lambda: False if DriverStation.isTest() else True",
    ],
)
def test_an_inverted_guard_in_robotpy_is_none(tmp_path, guard, reads):
    body = four(f"self.driver.{{key}}().and_({guard})!")
    found = judged(tmp_path, python(body), name=PYTHON)["guard"]

    assert (found.status, found.points) == ("failed", 0)
    reads(found.seen)


@pytest.mark.parametrize(
    ("decorated", "right"),
    [
        ("onlyIf(DriverStation::isTest)", True),
        ("unless(() -> !DriverStation.isTest())", True),
        ("unless(DriverStation::isFMSAttached)", True),
        ("unless(DriverStation::isTest)", False),
        ("onlyIf(() -> !DriverStation.isTest())", False),
        ("unless(DriverStation::isTeleop)", False),
    ],
)
def test_a_commands_own_condition_is_read_with_its_sign(tmp_path, decorated, right):
    bound = PLAIN.replace(f".and({START})", "").replace("));", f").{decorated});")

    assert (judged(tmp_path, java(bound))["guard"].status == "passed") is right


@pytest.mark.parametrize(
    "guard",
    [
        "RobotModeTriggers.test().negate().negate()",
        "() -> !(!DriverStation.isTest())",
        "() -> DriverStation.isTest() == true",
        "() -> DriverStation.isTest() ? true : false",
        "() -> !DriverStation.isFMSAttached()",
    ],
)
def test_a_guard_turned_round_twice_and_one_that_excludes_matches_are_guards(tmp_path, guard):
    assert judged(tmp_path, java(PLAIN.replace(START, guard)))["guard"].status == "passed"


HINDERED = {  # what follows the command of each test, and what its author is told
    "unless(() -> true)": "from starting",
    "unless(() -> !false)": "from starting",
    "onlyIf(() -> false)": "from starting",
    "onlyIf(() -> 2 < 1)": "from starting",
    "onlyWhile(() -> Boolean.FALSE)": "from starting",
    "onlyWhile(() -> DriverStation.isTest() && false)": "from starting",
    "onlyIf(this::never)": "from starting",
    "beforeStarting(Commands.idle())": "from starting",
    "beforeStarting(Commands.waitSeconds(60))": "from starting",
    "until(() -> true)": "early",
    "withTimeout(0.1)": "early",
    "withTimeout(Seconds.of(0.1))": "early",
    "withTimeout(kShort)": "early",
    "withTimeout(howLong())": "the grader cannot see",
    "raceWith(Commands.waitSeconds(0.1))": "early",
    "raceWith(Commands.none())": "early",
    "withDeadline(Commands.waitSeconds(1))": "early",
    "butOnlyIfThatIsFine()": "the grader cannot see",
}
NEVER = "boolean never() { return false; } static final double kShort = 0.5;"


@pytest.mark.parametrize("decorated", HINDERED)
def test_a_test_that_is_bound_and_cannot_run_whole_is_not_held(tmp_path, decorated):
    bound = PLAIN.replace("));", f").{decorated});")
    found = judged(tmp_path, java(bound, more=NEVER))["held"]

    assert (found.status, found.points < 3) == ("failed", True)
    assert HINDERED[decorated] in found.seen


@pytest.mark.parametrize("decorated", ["withTimeout(0.1)", "unless(() -> true)"])
def test_a_decorator_in_the_subsystems_own_method_counts_as_well(tmp_path, decorated):
    beside = SUBSYSTEM.replace("(way);", f"(way).{decorated};")

    assert judged(tmp_path, java(PLAIN, beside=beside))["held"].status == "failed"


@pytest.mark.parametrize(
    "decorated",
    [
        'withName("test")',
        "finallyDo(() -> System.out.println())",
        "beforeStarting(() -> System.out.println())",
        'beforeStarting(Commands.print("go"))',
        "withInterruptBehavior(InterruptionBehavior.kCancelIncoming)",
        "ignoringDisable(false)",
        "withTimeout(10)",
        "withTimeout(Seconds.of(12))",
        "until(m_arm::atLimit)",
        "until(() -> false)",
        "unless(() -> false)",
        "unless(DriverStation::isFMSAttached)",
        "onlyIf(() -> kCharacterize)",
        "onlyWhile(() -> true)",
        "raceWith(Commands.waitSeconds(20))",
        "deadlineWith(Commands.waitSeconds(0.1))",
        'alongWith(Commands.print("go"))',
        'andThen(Commands.print("done"))',
    ],
)
def test_a_decorator_that_lets_a_test_run_is_right(tmp_path, decorated):
    bound = PLAIN.replace("));", f").{decorated});")
    more = "static final boolean kCharacterize = false;"

    found = judged(tmp_path, java(bound, more=more))

    assert {found[name].status for name in ("held", "each-once", "guard")} == {"passed"}


@pytest.mark.parametrize("decorated", ["unless(() -> false)", "onlyIf(() -> 1 < 2)"])
def test_a_condition_that_always_holds_guards_nothing(tmp_path, decorated):
    bound = PLAIN.replace(f".and({START})", "").replace("));", f").{decorated});")

    assert judged(tmp_path, java(bound))["guard"].status == "failed"


@pytest.mark.parametrize(
    ("guard", "check"),
    [
        ("() -> DriverStation.isTest() && false", "held"),
        ("new Trigger(() -> false).and(RobotModeTriggers.test())", "held"),
        ("RobotModeTriggers.test().and(RobotModeTriggers.teleop())", "held"),
        ("RobotModeTriggers.test().and(() -> !DriverStation.isTest())", "held"),
        ("RobotModeTriggers.test().debounce(100)", "held"),
        ("RobotModeTriggers.test().debounce(later())", "held"),
        ("() -> DriverStation.isTest() || true", "guard"),
        ("() -> DriverStation.isTest() || !false", "guard"),
    ],
)
def test_a_trigger_that_never_changes_or_answers_late_is_told(tmp_path, guard, check):
    found = judged(tmp_path, java(PLAIN.replace(START, guard)))

    assert found[check].status == "failed"


@pytest.mark.parametrize(
    "guard", [f"{START}.debounce(0.1)", "() -> DriverStation.isTest() && true"]
)
def test_a_short_debounce_and_a_part_that_is_always_true_are_right(tmp_path, guard):
    found = judged(tmp_path, java(PLAIN.replace(START, guard)))

    assert {found[name].status for name in ("held", "guard")} == {"passed"}


LOOP = "CommandScheduler.getInstance().getDefaultButtonLoop()"


@pytest.mark.parametrize(
    ("before", "after", "right"),
    [
        ("", f"{LOOP}.clear();", False),
        ("", "CommandScheduler.getInstance().getActiveButtonLoop().clear();", False),
        ("", f"var loop = {LOOP};\nloop.clear();", False),
        (f"{LOOP}.clear();", "", True),
        ("", "m_list.clear();", True),
        ("", "CommandScheduler.getInstance().cancelAll();", True),  # at the start nothing runs
        ("", f"m_driver.back().onTrue(Commands.runOnce(() -> {LOOP}.clear()));", True),
    ],
)
def test_bindings_that_are_cleared_again_are_none(tmp_path, before, after, right):
    found = judged(tmp_path, java(f"{before}\n{PLAIN}\n{after}"))["held"]

    assert (found.status == "passed") is right
    assert right or "removes the binding" in found.seen


SCHEDULER = "CommandScheduler.getInstance()"
IMPORT = "import edu.wpi.first.wpilibj2.command.Command;"


@pytest.mark.parametrize(
    ("before", "after", "right"),
    [
        ("", f"{SCHEDULER}.disable();", False),
        (f"{SCHEDULER}.disable();", "", False),
        (f"{SCHEDULER}.disable();", f"{SCHEDULER}.enable();", True),
        ("", "m_leds.disable();", True),
        ("", f"m_driver.back().onTrue(Commands.runOnce(() -> {SCHEDULER}.disable()));", True),
    ],
)
def test_a_scheduler_that_is_turned_off_runs_no_test(tmp_path, before, after, right):
    found = judged(tmp_path, java(f"{before}\n{PLAIN}\n{after}"))["held"]

    assert (found.status == "passed") is right
    assert right or "turns the command scheduler off" in found.seen


@pytest.mark.parametrize(
    ("method", "body", "right"),
    [
        ("periodic", f"{SCHEDULER}.cancelAll();", False),
        ("simulationPeriodic", f"{SCHEDULER}.cancelAll();", False),
        ("periodic", f"if (getCurrentCommand() == null) {{ {SCHEDULER}.cancelAll(); }}", True),
        ("stop", f"{SCHEDULER}.cancelAll();", True),  # nobody calls it
        ("periodic", f"Runnable later = () -> {SCHEDULER}.cancelAll();", True),
    ],
)
def test_a_test_that_every_loop_cancels_does_not_last(tmp_path, method, body, right):
    text = (SOLUTIONS / JAVA).read_text(encoding="utf-8")
    marked = "  /** Makes the command that turns"
    added = f"  public void {method}() {{ {body} }}\n{marked}"
    text = text.replace(IMPORT, f"{IMPORT}\n{IMPORT.replace('Command;', 'CommandScheduler;')}")
    found = judged(tmp_path, text.replace(marked, added, 1))["held"]

    assert (found.status == "passed") is right
    assert right or "cancelAll() ends the test" in found.seen


@pytest.mark.parametrize(
    ("declared", "added", "right"),
    [
        ("private SysIdRoutine", "public void periodic() { m_routine = null; }", False),
        ("private SysIdRoutine", "ExampleSubsystem() { m_routine = null; }", False),
        ("private SysIdRoutine", "Object m_last; public void periodic() { m_last = null; }", True),
    ],
)
def test_a_routine_that_is_set_to_null_runs_no_test(tmp_path, declared, added, right):
    text = (SOLUTIONS / JAVA).read_text(encoding="utf-8")
    text = text.replace("private final SysIdRoutine", declared)
    marked = "  /** Makes the command that turns"
    found = judged(tmp_path, text.replace(marked, f"  {added}\n{marked}", 1))["held"]

    assert (found.status == "passed") is right
    assert right or "without its routine" in found.seen


@pytest.mark.parametrize(
    ("decorated", "right"),
    [
        ("unless(lambda: True)", False),
        ("onlyIf(lambda: 1 > 2)", False),
        ("withTimeout(0.1)", False),
        ("until(lambda: True)", False),
        ("withTimeout(10)", True),
        ('withName("test")', True),
        ("unless(DriverStation.isFMSAttached)", True),
    ],
)
def test_decorators_are_read_in_robotpy_as_well(tmp_path, decorated, right):
    body = four("self.driver.{key}().and_(self.driver.start())!")
    bound = "\n".join(f"{line[:-1]}.{decorated})" for line in body.splitlines())
    found = judged(tmp_path, python(bound), name=PYTHON)["held"]

    assert (found.status == "passed") is right


IN_2027 = (  # where the classes of the solution are in WPILib 2027
    ("edu.wpi.first.wpilibj2.command", "org.wpilib.command2"),
    ("edu.wpi.first.wpilibj.sysid", "org.wpilib.sysid"),
    ("edu.wpi.first.units", "org.wpilib.units"),
    ("kForward", "FORWARD"),
    ("kReverse", "REVERSE"),
)


def answer_of(season, *changes):
    text = re.sub(r"^ *// -{3}.*\n", "", (SOLUTIONS / JAVA).read_text("utf-8"), flags=re.MULTILINE)
    for old, new in (*(IN_2027 if season == 2027 else ()), *changes):
        assert old in text
        text = text.replace(old, new)
    return text


def test_utility_mode_guards_a_program_of_2027(tmp_path):
    found = judged(
        tmp_path, answer_of(2027, ("RobotModeTriggers.test", "RobotModeTriggers.utility"))
    )

    assert [one.status for one in found.values()] == ["passed"] * len(found)
    assert found["guard"].hint == ""


def test_test_mode_in_a_program_of_2027_is_right_but_called_by_its_old_name(tmp_path):
    found = judged(tmp_path, answer_of(2027))

    assert found["guard"].status == "passed"
    assert "RobotModeTriggers.utility()" in found["guard"].hint


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("RobotModeTriggers.test()", "RobotModeTriggers.utility()"),
        ("RobotModeTriggers.test()", "new Trigger(RobotState::isUtilityEnabled)"),
        ("m_motor.set(", "m_motor.setThrottle("),
    ],
)
def test_a_name_of_2027_in_a_program_of_2026_does_not_compile(old, new, tmp_path):
    one = "import com.ctre.phoenix6.hardware.TalonFX;\n"
    imported = (one, one + "import edu.wpi.first.wpilibj.RobotState;\n")

    found = judged(tmp_path, answer_of(2026, imported, (old, new)))["held"]

    assert found.status == "failed"
    assert "a name of WPILib 2027" in found.seen
