"""The same four bindings, written in the many ways that teams write them."""

import textwrap

from grader.robotcode.binding_facts import Guard

FOUR = [
    ("quasistatic", "forward"),
    ("quasistatic", "reverse"),
    ("dynamic", "forward"),
    ("dynamic", "reverse"),
]

SUBSYSTEM = """
class Arm extends SubsystemBase {
  private final SysIdRoutine m_routine = new SysIdRoutine(config(), mechanism());
  public Command quasistatic(SysIdRoutine.Direction way) { return m_routine.quasistatic(way); }
  public Command dynamic(SysIdRoutine.Direction way) { return m_routine.dynamic(way); }
}
"""
FIELDS = """
  private final Arm m_arm = new Arm();
  private final CommandXboxController m_driver = new CommandXboxController(0);
  private final CommandXboxController m_operator = new CommandXboxController(1);
"""


def java(body, *, fields=FIELDS, more="", beside=SUBSYSTEM):
    return (
        f"public class RobotContainer {{\n{fields}\n  public RobotContainer() {{\n"
        f"    m_arm.setDefaultCommand(m_arm.run(() -> m_driver.getLeftY()));\n{body}\n  }}\n"
        f"{more}\n}}\n{beside}"
    )


HELD = {  # what an exclamation mark stands for at the end of a line, and two of them for 2027
    "m_": (
        ".whileTrue(m_arm.{kind}(Direction.k{Way}));",
        ".whileTrue(m_arm.{kind}(Direction.{WAY}));",
    ),
    "self": (
        ".whileTrue(self.arm.{kind}(Direction.k{Way}))",
        ".while_true(self.arm.{kind}(Direction.{WAY}))",
    ),
}


def four(line, *, keys="abxy"):
    """The same line for each of the four: {key}, {Kind}, {kind}, {Way}, {WAY} and {way} in it."""
    held = HELD["self" if "self." in line else "m_"]
    line = line.replace("!!", held[1]).replace("!", held[0])
    rows = []
    for key, (kind, way) in zip(keys, FOUR, strict=True):
        words = {"key": key, "kind": kind, "Kind": kind.capitalize(), "way": way}
        rows.append(line.format(**words, Way=way.capitalize(), WAY=way.upper()))
    return "\n".join(rows)


PLAIN = four("m_driver.{key}().and(m_driver.start())!")
HELPER = """
  private void bind(Trigger button, Command test) {
    button.and(m_driver.back()).whileTrue(test);
  }
"""
NAMED = four(
    "public Command sysId{Kind}{Way}() {{\n"
    "  return m_routine.{kind}(SysIdRoutine.Direction.k{Way});\n}}"
)
STYLES = {
    "a chord": (java(PLAIN), Guard.CHORD),
    "2027": (
        java(four("m_driver.{key}().and(m_driver.start())!!")),
        Guard.CHORD,
    ),
    "utility mode, as 2027 calls it": (
        java(four("m_driver.{key}().and(RobotModeTriggers.utility())!!")),
        Guard.TEST_MODE,
    ),
    "utility mode of RobotState": (
        java(
            "Trigger utility = new Trigger(RobotState::isUtilityEnabled);\n"
            + four("utility.and(m_driver.{key}())!!")
        ),
        Guard.TEST_MODE,
    ),
    "the lesson's names": (
        java(
            four(
                "m_driver.{key}().and(RobotModeTriggers.test())"
                ".whileTrue(m_arm.sysId{Kind}{Way}());"
            ),
            beside="class Arm extends SubsystemBase {\n"
            "  private final SysIdRoutine m_routine = new SysIdRoutine(config(), mechanism());\n"
            + NAMED
            + "\n}\n",
        ),
        Guard.TEST_MODE,
    ),
    "triggers in variables": (
        java(
            "Trigger safe = m_driver.leftBumper();\n"
            + four("Trigger {key} = m_driver.{key}();\nsafe.and({key})!")
        ),
        Guard.CHORD,
    ),
    "a helper": (
        java(four("bind(m_driver.{key}(), m_arm.{kind}(Direction.k{Way}));"), more=HELPER),
        Guard.CHORD,
    ),
    "a switch on the dashboard": (
        java(
            four("m_driver.{key}().and(this::enabled)!"),
            more='boolean enabled() { return SmartDashboard.getBoolean("SysId", false); }',
        ),
        Guard.TOGGLE,
    ),
    "a switch as a lambda": (
        java(
            four("m_driver.{key}().and(() -> m_on)!"),
            fields=FIELDS + "  private boolean m_on = false;\n",
            more="void set(boolean on) { m_on = on; }",
        ),
        Guard.TOGGLE,
    ),
    "a constant": (
        java(
            "if (kCharacterize) {\n" + PLAIN.replace(".and(m_driver.start())", "") + "\n}",
            fields=FIELDS + "  private static final boolean kCharacterize = false;\n",
        ),
        Guard.TOGGLE,
    ),
    "only if": (
        java(
            four(
                "m_driver.{key}()"
                ".whileTrue(m_arm.{kind}(Direction.k{Way}).onlyIf(DriverStation::isTest));"
            )
        ),
        Guard.TEST_MODE,
    ),
    "buttons by number": (
        java(
            four(
                "new JoystickButton(m_stick, {key}).and(() -> DriverStation.isTest())!", keys="1234"
            ),
            fields=FIELDS + "  private final Joystick m_stick = new Joystick(2);\n",
        ),
        Guard.TEST_MODE,
    ),
    "a test's loop": (
        java(
            four("m_driver.{key}(m_loop)!"),
            fields=FIELDS + "  private final EventLoop m_loop = new EventLoop();\n",
        ),
        Guard.TOGGLE,
    ),
    "decorated": (
        java(
            four(
                "m_driver.{key}().and(RobotModeTriggers.test()).whileTrue(Commands.sequence("
                'Commands.print("go"), m_arm.{kind}(Direction.k{Way})).withName("{kind}"));'
            )
        ),
        Guard.TEST_MODE,
    ),
    "which way by a boolean": (
        java(
            PLAIN.replace("Direction.kForward", "true").replace("Direction.kReverse", "false"),
            beside=SUBSYSTEM.replace("SysIdRoutine.Direction way", "boolean way").replace(
                "(way)", "(way ? Direction.kForward : Direction.kReverse)"
            ),
        ),
        Guard.CHORD,
    ),
    "a subsystem there is one of": (
        java(
            PLAIN.replace("m_arm.", "Arm.getInstance()."),
            beside=SUBSYSTEM.replace(
                "SubsystemBase {",
                "SubsystemBase {\n  static Arm arm = new Arm();\n"
                "  static Arm getInstance() { return arm; }",
            ),
        ),
        Guard.CHORD,
    ),
    "suppliers": (
        java(
            four(
                "new Trigger(() -> m_driver.getHID().get{key}Button()"
                " && m_driver.getHID().getStartButton())!",
                keys="ABXY",
            )
        ),
        Guard.CHORD,
    ),
}


ARM = """
class Arm(Subsystem):
    def __init__(self):
        self.routine = SysIdRoutine(SysIdRoutine.Config(), SysIdRoutine.Mechanism(None, None, self))

    def quasistatic(self, way):
        return self.routine.quasistatic(way)

    def dynamic(self, way):
        return self.routine.dynamic(way)
"""


def python(body, *, more=""):
    return f"""from commands2 import Subsystem
from commands2.button import CommandXboxController, JoystickButton, Trigger
from commands2.sysid import SysIdRoutine
from wpilib import DriverStation, RobotModeTriggers

Direction = SysIdRoutine.Direction

{ARM}

class RobotContainer:
    def __init__(self):
        self.arm = Arm()
        self.driver = CommandXboxController(0)
        self.operator = CommandXboxController(1)
        self.arm.setDefaultCommand(self.arm.run(lambda: self.driver.getLeftY()))
{textwrap.indent(body, "        ")}

{textwrap.indent(more, "    ")}
"""


PAIRS = four("(self.driver.{key}(), self.arm.{kind}(Direction.k{Way})),")
PYTHON_STYLES = {
    "and_": (four("self.driver.{key}().and_(DriverStation.isTest)!"), Guard.TEST_MODE),
    "&": (four("(self.driver.{key}() & self.driver.start())!"), Guard.CHORD),
    "2027": (four("self.driver.{key}().and_(self.driver.start())!!"), Guard.CHORD),
    "utility mode in snake case": (
        four("self.driver.{key}().and_(DriverStation.is_utility_enabled)!!"),
        Guard.TEST_MODE,
    ),
    "utility mode as a trigger of 2027": (
        four("self.driver.{key}().and_(RobotModeTriggers.utility())!!"),
        Guard.TEST_MODE,
    ),
    "a loop": (
        (
            f"for button, test in (\n{PAIRS}\n):\n"
            "    (button & Trigger(lambda: DriverStation.isTest())).whileTrue(test)"
        ),
        Guard.TEST_MODE,
    ),
    "side by side": (
        (
            "for button, way in zip([self.driver.a(), self.driver.b()], [Direction.kForward, "
            "Direction.kReverse]):\n"
            "    button.and_(self.driver.back()).whileTrue(self.arm.quasistatic(way))\n"
            "for button, way in zip((self.driver.x(), self.driver.y()), (Direction.kForward, "
            "Direction.kReverse)):\n"
            "    button.and_(self.driver.back()).whileTrue(self.arm.dynamic(way))"
        ),
        Guard.CHORD,
    ),
    "a function inside": (
        "def bind(button, test):\n    button.and_(self.driver.back()).whileTrue(test)\n"
        + four("bind(self.driver.{key}(), self.arm.{kind}(Direction.k{Way}))"),
        Guard.CHORD,
    ),
    "a lambda": (
        "self.on = False\n"
        + four("Trigger(lambda: self.driver.get{key}Button() and self.on)!", keys="ABXY"),
        Guard.TOGGLE,
    ),
    "buttons": (
        four("JoystickButton(self.driver, {key}).and_(self.driver.back())!", keys="1234"),
        Guard.CHORD,
    ),
}
