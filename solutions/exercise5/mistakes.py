"""Wrong answers to exercise 5, and what a learner must be told about each."""

import re
from collections.abc import Callable

from grader.mistake import Mistake, replacing

JAVA, PYTHON = "RobotContainer.java", "robotcontainer.py"

GUARD, GUARD_PYTHON = ".and(testing)", ".and_(testing)"
FACTORY = (
    "  public Command sysId{0}(SysIdRoutine.Direction direction) {{\n    return m_routine.{1}("
)


def without(pattern: str) -> Callable[[str], str]:
    """Make a wrong text by leaving out every line that a pattern finds."""

    def make(text: str) -> str:
        left = re.sub(rf"^.*(?:{pattern}).*\n", "", text, flags=re.MULTILINE)
        if left == text:
            raise ValueError(f"the solution no longer contains {pattern!r}")
        return left

    return make


MISTAKES = (
    Mistake(
        "started by a press",
        JAVA,
        replacing(("whileTrue", "onTrue")),
        "held",
        "runs to its timeout even after release",
    ),
    Mistake(
        "started by a press, Python",
        PYTHON,
        replacing(("whileTrue", "onTrue")),
        "held",
        "runs to its timeout even after release",
    ),
    Mistake(
        "started by one press and stopped by another",
        JAVA,
        replacing(("whileTrue", "toggleOnTrue")),
        "held",
        "takes a second press to stop",
    ),
    Mistake(
        "running while nobody holds the button",
        PYTHON,
        replacing(("whileTrue", "whileFalse")),
        "held",
        "runs as long as nobody presses",
    ),
    Mistake(
        "handed to the scheduler, and let go",
        JAVA,
        replacing(
            ("m_subsystem.sysId", "Commands.runOnce(() -> m_subsystem.sysId"),
            ("Direction.kForward));", "Direction.kForward).schedule()));"),
            ("Direction.kReverse));", "Direction.kReverse).schedule()));"),
        ),
        "held",
        "only starts another one",
    ),
    Mistake(
        "two tests on one button",
        JAVA,
        replacing(("m_driverController.b()", "m_driverController.a()")),
        "held",
        "share the trigger",
    ),
    Mistake(
        "two tests on one button, Python",
        PYTHON,
        replacing(("self.driver.y()", "self.driver.x()")),
        "held",
        "share the trigger",
    ),
    Mistake(
        "a method with the bindings that nobody calls",
        JAVA,
        replacing(("    configureBindings();\n", "")),
        "held",
        "nothing calls configureBindings",
    ),
    Mistake(
        "forward twice, never reverse",
        JAVA,
        replacing(
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
        ),
        "each-once",
        "quasistatic forward twice",
    ),
    Mistake(
        "quasistatic twice, never dynamic",
        PYTHON,
        replacing(("self.subsystem.dynamic(", "self.subsystem.quasistatic(")),
        "each-once",
        "quasistatic forward twice",
    ),
    Mistake(
        "a routine's dynamic method that runs the quasistatic test",
        JAVA,
        replacing(("m_routine.dynamic(", "m_routine.quasistatic(")),
        "factories",
        "no method makes dynamic forward and dynamic reverse",
    ),
    Mistake(
        "no reverse runs",
        PYTHON,
        without(r"reverse: k|\.[by]\(\)|kReverse\)\n        "),
        "each-once",
        "the reverse runs are no luxury".capitalize(),
        "M-REVERSE-WASTE",
    ),
    Mistake(
        "methods that others may not call",
        JAVA,
        replacing(("public Command sysId", "private Command sysId")),
        "factories",
        "other classes may not call sysIdQuasistatic",
    ),
    Mistake(
        "methods that others should not call",
        PYTHON,
        replacing((" quasistatic(", " _quasistatic("), ("subsystem.quasi", "subsystem._quasi")),
        "factories",
        "without a _ in front",
    ),
    Mistake(
        "no methods",
        JAVA,
        replacing(
            ("m_subsystem.sysIdQuasistatic", "m_subsystem.m_routine.quasistatic"),
            ("m_subsystem.sysIdDynamic", "m_subsystem.m_routine.dynamic"),
            (FACTORY.format("Quasistatic", "quasistatic") + "direction);\n  }\n", ""),
            (FACTORY.format("Dynamic", "dynamic") + "direction);\n  }\n", ""),
        ),
        "factories",
        "no method makes the command of a test",
    ),
    Mistake(
        "comments that name the test only",
        JAVA,
        replacing((": a slow ramp, which measures kS and kV", "")),
        "comments",
        "Which property of the mechanism",
    ),
    Mistake(
        "comments that name the property only",
        PYTHON,
        replacing(("Dynamic, forward: a step, which measures kA", "For kA")),
        "comments",
        "Which of the tests is this",
    ),
    Mistake(
        "comments that name neither",
        JAVA,
        replacing(("Dynamic, reverse: kA once more, from the other side", "Test D")),
        "comments",
        "Name the test, quasistatic or dynamic",
    ),
    Mistake(
        "kA from the slow ramp",
        PYTHON,
        replacing(("which measures kS and kV", "which measures kA")),
        "comments",
        "That is what the dynamic test measures",
    ),
    Mistake("no comment", JAVA, without("Dynamic, forward"), "comments", "no comment beside"),
    Mistake(
        "no guard", JAVA, replacing((GUARD, "")), "guard", "Ask for something a driver never does"
    ),
    Mistake(
        "no guard, Python",
        PYTHON,
        replacing((GUARD_PYTHON, "")),
        "guard",
        "Ask for something a driver never does",
    ),
    Mistake(
        "a guard on two of four",
        JAVA,
        replacing((f"x(){GUARD}", "x()"), (f"y(){GUARD}", "y()")),
        "guard",
        "2 of 4 bindings are guarded",
    ),
    Mistake(
        "test mode asked while the robot starts",
        PYTHON,
        replacing(
            (GUARD_PYTHON, ""),
            (
                "        self.configure_bindings()",
                "        if wpilib.DriverStation.isTest():\n            self.configure_bindings()",
            ),
        ),
        "guard",
        "asked once",
    ),
    Mistake(
        "a guard that a match opens",
        JAVA,
        replacing(("RobotModeTriggers.test()", "RobotModeTriggers.teleop()")),
        "guard",
        "a mode other than test mode",
    ),
    Mistake(
        "the guard inverted",
        JAVA,
        replacing(("RobotModeTriggers.test()", "RobotModeTriggers.test().negate()")),
        "guard",
        "Ask for test mode itself",
    ),
    Mistake(
        "the guard inverted, Python",
        PYTHON,
        replacing(
            (
                "testing = wpilib.DriverStation.isTest\n",
                "testing = lambda: not wpilib.DriverStation.isTest()\n",
            )
        ),
        "guard",
        "a mode other than test mode",
    ),
)
