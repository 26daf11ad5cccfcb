"""Mistakes that are made in Java robot code: some forty operators, each used at every place."""

import re
from collections.abc import Iterator

from mutation.text_operators import COMMON, Rule, all_changes, either, without_a_letter

COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
SENT = r"setVoltage\(voltage\.in\(Volts\)\)"
STATEMENT = r"^ {4,}[\w.]+(?:\([^\n]*\)|\s=[^\n]*);\n"
PERIODIC = "\n\n  @Override\n  public void periodic() {{\n    {};\n  }}"
WRAPPED = r"\b(?:Volts|Meters|MetersPerSecond|Rotations|RotationsPerSecond)\.of"
FORTH = r"SysIdRoutine\.Direction\.k"
LAST_WAY = rf"{FORTH}(?:Forward|Reverse)\)(?=\);)"
ASKS = "edu.wpi.first.wpilibj.DriverStation.isTest()"
SCHEDULER = "edu.wpi.first.wpilibj2.command.CommandScheduler.getInstance()"

RULES = (
    # Guards and buttons.
    Rule("negate-guard", r"RobotModeTriggers\.test\(\)", r"\g<0>.negate()"),
    Rule("negate-guard", r"\.and\(testing\)", ".and(testing.negate())"),
    Rule(
        "negate-guard",
        r"RobotModeTriggers\.test\(\)",
        "new Trigger(() -> !edu.wpi.first.wpilibj.DriverStation.isTest())",
    ),
    Rule("drop-guard", r"\.and\(testing\)", ""),
    Rule("guard-by-or", r"\.and\(testing\)", ".or(testing)"),
    Rule("guard-other-mode", r"RobotModeTriggers\.test\(\)", "RobotModeTriggers.teleop()"),
    Rule("guard-other-mode", r"RobotModeTriggers\.test\(\)", "RobotModeTriggers.autonomous()"),
    Rule("guard-other-mode", r"RobotModeTriggers\.test\(\)", "RobotModeTriggers.disabled()"),
    Rule("negate-button", r"(?<=m_driverController\.)[abxy]\(\)(?=\.and)", r"\g<0>.negate()"),
    Rule("discarded-command", r"(?<=return )m_routine\.\w+\(direction\)", r"runOnce(() -> \g<0>)"),
    Rule("reassign-guard", r"^( +)(?=m_driverController\.\w\(\)\.and)", r"\1testing = new Trigger(() -> true);\n\1"),
    Rule("may-not-run", r"^( +)(?=m_driverController\.\w\(\)\.and)", r"\1if (false) "),
    Rule("may-not-run", r"^( +)(?=m_driverController\.\w\(\)\.and)", r"\1if (true) return;\n\1"),
    # Bound, and yet it never starts, or ends long before its time.
    *(
        Rule("never-starts", LAST_WAY, rf"\g<0>.{decorator}")
        for decorator in (
            "unless(() -> true)",
            "unless(() -> !false)",
            "onlyIf(() -> false)",
            "onlyIf(() -> 1 > 2)",
            "onlyWhile(() -> false)",
            "onlyWhile(() -> edu.wpi.first.wpilibj.DriverStation.isTest() && false)",
        )
    ),
    *(
        Rule("ends-early", LAST_WAY, rf"\g<0>.{decorator}")
        for decorator in (
            "withTimeout(0.1)",
            "withTimeout(Seconds.of(0.1))",
            "until(() -> true)",
            "raceWith(edu.wpi.first.wpilibj2.command.Commands.waitSeconds(0.1))",
        )
    ),
    Rule("slow-trigger", r"\.and\(testing\)", r"\g<0>.debounce(100)"),
    Rule("slow-trigger", r"(?<=RobotModeTriggers\.test\(\))(?=;)", ".debounce(100)"),
    *(
        Rule("constant-guard", r"RobotModeTriggers\.test\(\)", f"new Trigger(() -> {ASKS} {more})")
        for more in ("&& false", "|| true", "&& !true", "|| !false")
    ),
    Rule("constant-guard", r"\.and\(testing\)", r"\g<0>.and(() -> false)"),
    *(
        Rule("clear-bindings", rf"^ +m_subsystem\.sysIdDynamic\({FORTH}Reverse\)\);\n", rf"\g<0>    {SCHEDULER}.{loop}().clear();\n")
        for loop in ("getDefaultButtonLoop", "getActiveButtonLoop")
    ),
    Rule("null-routine", r"^  private final( SysIdRoutine m_routine =[^;]*;\n)", r"  private\1\n  {\n    m_routine = null;\n  }\n"),
    Rule("never-starts", LAST_WAY, r"\g<0>.unless(edu.wpi.first.wpilibj.DriverStation::isTest)"),
    Rule("may-not-run", r"^( +)(?=m_driverController\.\w\(\)\.and)", r"\1if (1 > 2) "),
    Rule("may-not-run", r"^( +)(?=m_driverController\.\w\(\)\.and)", rf"\1if ({ASKS} && false) "),
    Rule("other-button", r"(?<=m_driverController)\.[abxy]\(\)", ".a()"),
    Rule("other-button", r"(?<=m_driverController)\.[abxy]\(\)", ".b()"),
    Rule("other-test", r"[qQ]uasistatic\(", lambda m: {"q": "d", "Q": "D"}[m[0][0]] + "ynamic("),
    Rule("other-test", r"[dD]ynamic\(", lambda m: {"d": "q", "D": "Q"}[m[0][0]] + "uasistatic("),
    Rule("fixed-direction", r"(?<=[cC]\()direction\)", "SysIdRoutine.Direction.kForward)"),
    Rule("hide-method", r"public Command", "private Command"),
    Rule("hide-method", r"public Command", "Command"),
    Rule("never-bind", r"^ +configureBindings\(\);\n", ""),
    Rule("wrong-comment", r"(?<=// )Quasistatic", "Dynamic", comments=True),
    Rule("wrong-comment", r"(?<=// )Dynamic", "Quasistatic", comments=True),
    Rule("drop-comment", r"// (?:Quasistatic|Dynamic)[^\n]*", "//", comments=True),
    # Copied and not changed, left for right.
    Rule("swap-sides", r"\bm_(?:left|right)\b", either("left", "right")),
    Rule("swap-sides", r'"(?:left|right)"', either("left", "right")),
    Rule("swap-top-and-bottom", r"\bm_(?:top|bottom)\w*", either("top", "bottom")),
    # Numbers that follow their unit, or do not.
    Rule("drop-conversion", r" \* [A-Z]+_PER_[A-Z]+", ""),
    Rule("double-conversion", r" \* ([A-Z]+_PER_[A-Z]+)", r"\g<0> * \1"),
    Rule("invert-conversion", r" \* ([A-Z]+_PER_[A-Z]+)", r" / \1"),
    Rule("double-seconds", r" / 60(?:\.0)?", r"\g<0> / 60.0"),
    Rule("diameter-for-radius", r"Math\.PI", "2 * Math.PI"),
    Rule("forget-pi", r"Math\.PI \* |\ \* Math\.PI", ""),
    Rule("unconverted", r"getMeters(?:PerSecond)?\(m_(\w+)\)", r"m_\1.getPosition().getValueAsDouble()"),
    Rule("unconverted", r"getMetersPerSecond\(m_(\w+)\)", r"m_\1.getVelocity().getValueAsDouble()"),
    Rule("other-unit", r"\bMeters(?=\.of)", "Feet"),
    Rule("other-unit", r"\bMeters(?=\.of)", "Inches"),
    Rule("other-unit", r"\bMeters(?=\.of)", "Rotations"),
    Rule("other-unit", r"\bMetersPerSecond(?=\.of)", "FeetPerSecond"),
    Rule("other-unit", r"\bMetersPerSecond(?=\.of)", "RotationsPerSecond"),
    Rule("other-unit", r"\bMetersPerSecond(?=\.of)", "Meters"),
    Rule("other-unit", r"\bMeters(?=\.of)", "MetersPerSecond"),
    Rule("other-unit", r"\bVolts(?=\.of)", "Millivolts"),
    Rule("other-unit", r"\bVolts(?=\.of)", "Amps"),
    Rule("other-unit", r"(?<=in\()Volts", "Millivolts"),
    Rule("other-unit", r"(?<=in\()Volts", "Meters"),
    Rule("other-unit", r"\bSeconds(?=\.of)", "Minutes"),
    Rule("other-unit", r"\bSeconds(?=\.of)", "Milliseconds"),
    Rule("other-unit", r"(?<=per\()Second", "Minute"),
    Rule("drop-per", r"\.per\(\w+\)", ""),
    Rule("angular-for-linear", r"linear(?=Position|Velocity)", "angular"),
    Rule("linear-for-angular", r"angular(?=Position|Velocity)", "linear"),
    Rule("raw-double", WRAPPED + r"(?=\()", ""),
    Rule("raw-double", r"\.getValueAsDouble\(\)", ""),
    Rule("raw-double", r"\b(?:Volts|Seconds)\.of\((\d[\d.]*)\)(?=[,)])", r"\1"),
    Rule("int-for-double", r"(?<![\w.])0\.5(?![\w.])", "1 / 2"),
    Rule("int-for-double", r"(?<![\w.])3\.5(?![\w.])", "(7 / 2)"),
    # Signs, quantities, sources.
    Rule("flip-sign", r"(?<=\.of\()(?=[\w.]+[(.])(?!\d)", "-"),
    Rule("flip-sign", r"(?<=return )(?=motor)", "-"),
    Rule("flip-sign", r"(?<=double \w{2} = )(?=\d)|(?<=ROTATION = )", "-"),
    Rule("position-for-velocity", r"get(?:Position|Velocity)\(\)", either("Position", "Velocity")),
    Rule("position-for-velocity", r"linear(?:Position|Velocity)", either("Position", "Velocity")),
    Rule("position-for-velocity", r"angular(?:Position|Velocity)", either("Position", "Velocity")),
    Rule("position-for-velocity", r"(?<=of\()getMeters(?=\()", "getMetersPerSecond"),
    Rule("position-for-velocity", r"(?<=of\()getMetersPerSecond(?=\()", "getMeters"),
    Rule("supply-voltage", r"getMotorVoltage|getAppliedOutput", "getSupplyVoltage"),
    Rule("current-for-voltage", r"getMotorVoltage|getAppliedOutput", "getStatorCurrent"),
    Rule("duty-for-voltage", r"getMotorVoltage", "getDutyCycle"),
    Rule("duty-for-voltage", r" \* \w+\.getBusVoltage\(\)", ""),
    Rule("nominal-battery", r"(?<= \* )\w+\.getBusVoltage\(\)", "12.0"),
    Rule("velocity-for-voltage", r"getMotorVoltage", "getVelocity"),
    Rule("asked-voltage", r"Volts\.of\(m_\w+\.getMotorVoltage\(\)\.getValueAsDouble\(\)\)", "m_asked"),
    # The voltage on its way.
    Rule("duty-cycle", SENT, "set(voltage.in(Volts) / 12.0)"),
    Rule("duty-cycle", SENT, "set(voltage.in(Volts))"),
    Rule("duty-cycle", SENT, "setControl(new DutyCycleOut(voltage.in(Volts) / 12.0))"),
    Rule("scaled-voltage", r"(?<=setVoltage\()voltage\.in\(Volts\)", r"\g<0> / 12.0"),
    Rule("scaled-voltage", r"(?<=setVoltage\()voltage\.in\(Volts\)", r"\g<0> * 2"),
    Rule("scaled-voltage", r"(?<=setVoltage\()voltage\.in\(Volts\)", r"\g<0> + 0.2"),
    Rule("constant-voltage", r"(?<=setVoltage\()voltage\.in\(Volts\)", "3.5"),
    Rule("constant-voltage", r"(?<=setVoltage\()voltage\.in\(Volts\)", "0"),
    Rule("closed-loop", SENT, "setControl(new VelocityVoltage(voltage.in(Volts)))"),
    Rule("closed-loop", SENT, "setControl(new PositionVoltage(voltage.in(Volts)))"),
    Rule("stop-motor", SENT, "stopMotor()"),
    Rule("clamp-voltage", r"(?<=setVoltage\()voltage\.in\(Volts\)", r"Math.min(\g<0>, 2.0)"),
    Rule("clamp-voltage", r"(?<=setVoltage\()voltage\.in\(Volts\)", r"Math.max(-3, \g<0>)"),
    Rule("one-way-voltage", r"(?<=setVoltage\()voltage\.in\(Volts\)", r"\g<0> > 0 ? \g<0> : 0"),
    Rule("one-way-voltage", r"(?<=setVoltage\()voltage\.in\(Volts\)", r"Math.abs(\g<0>)"),
    Rule("stop-after", r"^( +m_\w+\.)setVoltage\([^\n]*\n", r"\g<0>\1stopMotor();\n"),
    Rule("stop-after", r"^( +m_\w+\.)setVoltage\([^\n]*\n", r"\g<0>\1setVoltage(0);\n"),
    Rule("may-not-run", r"^( +)(?=m_\w+\.setVoltage)", r"\1if (voltage.in(Volts) > 3) return;\n\1"),
    Rule("may-not-run", r"^( +)(?=m_\w+\.setVoltage)", r"\1if (true) return;\n\1"),
    Rule("may-not-run", r"^( +)(?=m_\w+\.setVoltage)", r"\1if (voltage.in(Volts) > 0) "),
    Rule("may-not-run", r"^( +)(?=m_\w+\.setVoltage)", r"\1while (false) "),
    Rule("may-not-run", r"^( +)(?=log\.motor)", r"\1if (true) return;\n\1"),
    Rule("lost-sign", r"(?<=[( ])[mM]\w+\.get(?!Applied)\w+\(\)\.getValueAsDouble\(\)", r"Math.abs(\g<0>)"),
    Rule("lost-sign", r"(?<=[( ])motor\.get\w+\(\)\.getValueAsDouble\(\)", r"Math.abs(\g<0>)"),
    Rule("lost-sign", r"m_\w+Encoder\.get\w+\(\)|m_\w+\.getAppliedOutput\(\)", r"Math.abs(\g<0>)"),
    Rule("moves-in-periodic", r"\n\}\n\Z", PERIODIC.format("m_right.setVoltage(0)") + r"\g<0>"),
    Rule("moves-in-periodic", r"\n\}\n\Z", PERIODIC.format("m_top.stopMotor()") + r"\g<0>"),
    Rule("own-motor-class", r"new (?:TalonFX|SparkMax)\([^)]*\)(?=;)", r"\g<0> { public void setVoltage(double v) { super.setVoltage(v / 2); } }"),
    Rule("own-motor-class", r"(?<=^import )com\.[\w.]+(?=\.(?:TalonFX|SparkMax);)", "frc.robot.lib"),
    Rule("own-unit", r"edu\.wpi\.first\.units\.Units(?=\.(?:Meters|MetersPerSecond|Volts|Seconds);)", "frc.robot.Units"),
    Rule("measure-for-number", r"voltage\.in\(Volts\)", "voltage"),
    # Constants and arguments.
    Rule("swap-config", r"(Volts\.of\(0\.5\)\.per\(Second\)), (Volts\.of\(3\.5\))", r"\2, \1"),
    Rule("swap-config", r"(Volts\.of\(3\.5\)), (Seconds\.of\(10\))", r"\2, \1"),
    Rule("swap-callbacks", r"(this::drive), (this::record)", r"\2, \1"),
    Rule("swap-callbacks", r"(this::record), (this)\b", r"\2, \1"),
    Rule("same-callback", r"this::drive", "this::record"),
    Rule("same-callback", r"this::record", "this::drive"),
    Rule("other-feedforward", r"(?<=new )(?:SimpleMotor|Elevator)(?=Feedforward)", "Arm"),
    Rule("other-feedforward", r"(?<=new )Arm(?=Feedforward)", "Elevator"),
    Rule("null-argument", r"(?<=, )this(?=\))", "null"),
    Rule("null-argument", r"this::\w+", "null"),
    Rule("null-argument", r"Volts\.of\(0\.5\)\.per\(Second\)|Volts\.of\(3\.5\)", "null"),
    Rule("drop-argument", r", this(?=\))", ""),
    Rule("drop-argument", r", Seconds\.of\(10\)", ""),
    # Statements and declarations.
    Rule("drop-statement", STATEMENT, ""),
    Rule("drop-link", r"^ +\.(?:voltage|linear\w+|angular\w+)\([^\n]*\)(?=\n)", ""),
    Rule("drop-link", r"^ +\.(?:voltage|linear\w+|angular\w+)\([^\n]*\)(?=;\n)", ""),
    Rule("drop-motor", r"^ +log\.motor\([^;]*;\n", ""),
    Rule("no-subsystem", r" extends SubsystemBase", ""),
    Rule("no-subsystem", r" extends SubsystemBase", " extends Command"),
    Rule("drop-field", r"^  private final [A-Z]\w+ m_\w+ = [^\n]*;\n", ""),
    Rule("double-parameter", r"Voltage voltage", "double voltage"),
    Rule("drop-unit", r" // V[^\n]*", "", comments=True),
    Rule("other-unit", r"(?<=// )V·s(?:²)?/\w+", "V", comments=True),
    # Code that cannot compile.
    Rule("drop-import", r"^import [^\n]*\n", ""),
    Rule("misspell-import", r"^import [\w. ]*\.(?=[A-Z]\w{4,};)\w+", without_a_letter),
    Rule("misspell-class", r"(?<![\w.\"])(?=[A-Z]\w{5,})(?![A-Z_]+\b)\w+(?!\w*;\n)", without_a_letter),
    Rule("misspell-variable", r"(?<![\w.])m_\w{4,}(?![\w(])", without_a_letter),
    Rule("misspell-constant", r"(?<![\w.])[A-Z]+_PER_[A-Z]+\b", without_a_letter),
    *COMMON,
)  # fmt: skip


def changes_of(text: str) -> Iterator[tuple[str, int, str]]:
    """Operator, line and text of every mutant of a Java file."""
    return all_changes(RULES, text, comment=COMMENT)
