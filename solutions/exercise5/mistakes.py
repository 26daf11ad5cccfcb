"""Wrong answers to exercise 5, and what a learner must be told about each."""

import re
from collections.abc import Callable

from grader.exercise.mistake import Mistake, replace_text

JAVA, PYTHON = "RobotContainer.java", "robotcontainer.py"

GUARD, GUARD_PYTHON = ".and(testing)", ".and_(testing)"
FACTORY = (
    "  public Command sysId{0}(SysIdRoutine.Direction direction) {{\n    return m_routine.{1}("
)


def remove_pattern(pattern: str) -> Callable[[str], str]:
    """Make a wrong text by leaving out every line that a pattern finds."""

    def edit_text(text: str) -> str:
        left = re.sub(rf"^.*(?:{pattern}).*\n", "", text, flags=re.MULTILINE)
        if left == text:
            raise ValueError(f"the solution no longer contains {pattern!r}")
        return left

    return edit_text


MISTAKES = (
    Mistake("started by a press", JAVA, replace_text(("whileTrue", "onTrue")), "held",
        "Once started, the test runs to its"),
    Mistake("started by a press, Python", PYTHON, replace_text(("whileTrue", "onTrue")), "held",
        "Once started, the test runs to its"),
    Mistake("started by one press and stopped by another", JAVA,
        replace_text(("whileTrue", "toggleOnTrue")), "held", "You need a second press to stop"),
    Mistake("running while nobody holds the button", PYTHON,
        replace_text(("whileTrue", "whileFalse")), "held", "runs while nobody holds the button"),
    Mistake("handed to the scheduler, and let go", JAVA,
        replace_text(
            (
                "import edu.wpi.first.wpilibj2.command.Command;",
                (
                    "import edu.wpi.first.wpilibj2.command.Command;\n"
                    "import edu.wpi.first.wpilibj2.command.Commands;"
                ),
            ),
            ("m_subsystem.sysId", "Commands.runOnce(() -> m_subsystem.sysId"),
            ("Direction.kForward));", "Direction.kForward).schedule()));"),
            ("Direction.kReverse));", "Direction.kReverse).schedule()));"),
        ), "held", "Does the button only start another command"),
    Mistake("a test asked of the class, as in WPILib's documentation", PYTHON,
        replace_text(("return self.routine.", "return SysIdRoutine.")), "held",
        "not the class SysIdRoutine"),
    Mistake("a test asked of the class, in Java", JAVA,
        replace_text(("return m_routine.", "return SysIdRoutine.")), "held",
        "quasistatic() belongs to an object: SysIdRoutine is the class"),
    Mistake("the guard or the button", JAVA, replace_text((".and(testing)", ".or(testing)")),
        "guard", "If both must be true"),
    Mistake("two tests on one button", JAVA,
        replace_text(("m_driverController.b()", "m_driverController.a()")), "held",
        "share the trigger"),
    Mistake("a button without its parentheses, which is asked too late", PYTHON,
        replace_text(("self.driver.a().", "self.driver.back().negate().and_(self.driver.a).")),
        "held", "no button was found that runs"),
    Mistake("two tests on one button, Python", PYTHON,
        replace_text(("self.driver.y()", "self.driver.x()")), "held", "share the trigger"),
    Mistake("one test after the other on one button", JAVA,
        replace_text(
            (
                "m_subsystem.sysIdDynamic(SysIdRoutine.Direction.kForward));",
                (
                    "m_subsystem.sysIdDynamic(SysIdRoutine.Direction.kForward).andThen(\n"
                    "            m_subsystem.sysIdDynamic(SysIdRoutine.Direction.kReverse)));"
                ),
            )
        ), "held", "one after the other"),
    Mistake("a method with the bindings that nobody calls", JAVA,
        replace_text(("    configureBindings();\n", "")), "held",
        "nothing calls configureBindings"),
    Mistake("forward twice, never reverse", JAVA,
        replace_text(
            (
                (
                    "b().and(testing).whileTrue(\n"
                    "        m_subsystem.sysIdQuasistatic(SysIdRoutine.Direction.kReverse)"
                ),
                (
                    "b().and(testing).whileTrue(\n"
                    "        m_subsystem.sysIdQuasistatic(SysIdRoutine.Direction.kForward)"
                ),
            )
        ), "each-once", "quasistatic forward twice"),
    Mistake("quasistatic twice, never dynamic", PYTHON,
        replace_text(("self.subsystem.dynamic(", "self.subsystem.quasistatic(")), "each-once",
        "quasistatic forward twice"),
    Mistake("a routine's dynamic method that runs the quasistatic test", JAVA,
        replace_text(("m_routine.dynamic(", "m_routine.quasistatic(")), "factories",
        "no method makes dynamic forward and dynamic reverse"),
    Mistake("no reverse runs", PYTHON,
        remove_pattern(r"reverse: k|\.[by]\(\)|kReverse\)\n        "),
        "each-once", "You need the reverse runs", "M-REVERSE-WASTE"),
    Mistake("methods that others may not call", JAVA,
        replace_text(("public Command sysId", "private Command sysId")), "factories",
        "other classes may not call sysIdQuasistatic"),
    Mistake("methods that others should not call", PYTHON,
        replace_text((" quasistatic(", " _quasistatic("), ("subsystem.quasi", "subsystem._quasi")),
        "factories", "without a _ in front"),
    Mistake("no methods", JAVA,
        replace_text(
            ("m_subsystem.sysIdQuasistatic", "m_subsystem.m_routine.quasistatic"),
            ("m_subsystem.sysIdDynamic", "m_subsystem.m_routine.dynamic"),
            (FACTORY.format("Quasistatic", "quasistatic") + "direction);\n  }\n", ""),
            (FACTORY.format("Dynamic", "dynamic") + "direction);\n  }\n", ""),
        ), "factories", "no method makes the command of a test"),
    Mistake("comments that name the test only", JAVA,
        replace_text((": a slow ramp, which measures kS and kV", "")), "comments",
        "Which property of the mechanism"),
    Mistake("comments that name the property only", PYTHON,
        replace_text(("Dynamic, forward: a step, which measures kA", "For kA")), "comments",
        "Which of the tests is this"),
    Mistake("comments that name neither", JAVA,
        replace_text(("Dynamic, reverse: kA once more, from the other side", "Test D")), "comments",
        "Name the test, quasistatic or dynamic"),
    Mistake("kA from the slow ramp", PYTHON,
        replace_text(("which measures kS and kV", "which measures kA")), "comments",
        "test measures. What does the"),
    Mistake("no comment", JAVA, remove_pattern("Dynamic, forward"), "comments",
        "no comment next to"),
    Mistake("no guard", JAVA, replace_text((GUARD, "")), "guard",
        "Use something that never happens in a"),
    Mistake("no guard, Python", PYTHON, replace_text((GUARD_PYTHON, "")), "guard",
        "Use something that never happens in a"),
    Mistake("a guard on two of four", JAVA,
        replace_text((f"x(){GUARD}", "x()"), (f"y(){GUARD}", "y()")), "guard",
        "2 of 4 tests are guarded"),
    Mistake("test mode asked while the robot starts", PYTHON,
        replace_text(
            (GUARD_PYTHON, ""),
            (
                "        self.configure_bindings()",
                "        if wpilib.DriverStation.isTest():\n            self.configure_bindings()",
            ),
        ), "guard", "checks test mode only once, while the"),
    Mistake("a guard that a match opens", JAVA,
        replace_text(("RobotModeTriggers.test()", "RobotModeTriggers.teleop()")), "guard",
        "starts its test in teleop mode, not in test mode"),
    Mistake("the guard inverted", JAVA,
        replace_text(("RobotModeTriggers.test()", "RobotModeTriggers.test().negate()")), "guard",
        "Then it can start in a"),
    Mistake("the guard inverted, Python", PYTHON,
        replace_text(
            (
                "testing = wpilib.DriverStation.isTest\n",
                "testing = lambda: not wpilib.DriverStation.isTest()\n",
            )
        ), "guard", "starts its test in teleop mode, not in test mode"),
    Mistake("a direction that is not imported", JAVA,
        replace_text(("(SysIdRoutine.Direction.k", "(Direction.k")), "held",
        "import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine.Direction;"),
    Mistake("a method that returns no command", PYTHON,
        replace_text(("return self.routine.", "self.routine.")), "held", "needs a command"),
    Mistake("a misspelled binding", JAVA, replace_text(("whileTrue", "whileTreu")), "held",
        "Did you mean whileTrue?"),
    Mistake("a misspelled method of the routine", PYTHON,
        replace_text(("self.routine.dynamic", "self.routine.dynamik")), "factories",
        "Did you mean dynamic?"),
    Mistake("a method that the subsystem spells otherwise", JAVA,
        replace_text(("m_subsystem.sysIdDynamic", "m_subsystem.sysIdDynamik")), "held",
        "Did you mean sysIdDynamic?"),
)  # fmt: skip
