"""Mistakes that are made in RobotPy code: some forty operators, each used at every place."""

import re
from collections.abc import Iterator

from mutation.text_operators import COMMON, Rule, all_changes, either, without_a_letter

COMMENT = re.compile(r'#[^\n]*|"""(?:.|\n)*?"""')
PERIODIC = "\n\n    def periodic(self) -> None:\n        {}\n"
SENT = r"setVoltage\(voltage\)"
ASKS = r"(?:wpilib\.)?DriverStation\.isTest"
LAST_WAY = r"SysIdRoutine\.Direction\.k(?:Forward|Reverse)\)(?=\n)"
SCHEDULER = "CommandScheduler.getInstance()"

RULES = (
    # Guards and buttons.
    Rule("negate-guard", rf"= {ASKS}\n", "= lambda: not wpilib.DriverStation.isTest()\n"),
    Rule("negate-guard", r"and_\(testing\)", "and_(lambda: not testing())"),
    Rule("drop-guard", r"\.and_\(testing\)", ""),
    Rule("guard-by-or", r"\.and_\(testing\)", ".or_(testing)"),
    Rule("guard-other-mode", r"(?<=DriverStation\.)isTest", "isTeleop"),
    Rule("guard-other-mode", r"(?<=DriverStation\.)isTest", "isAutonomous"),
    Rule("guard-other-mode", r"(?<=DriverStation\.)isTest", "isEnabled"),
    Rule("guard-called-once", rf"= {ASKS}\n", "= wpilib.DriverStation.isTest()\n"),
    Rule("negate-button", r"(?<=driver\.)[abxy]\(\)(?=\.and_)", r"\g<0>.negate()"),
    Rule("discarded-command", r"(?<=return )self\.routine\.\w+\(direction\)", r"self.runOnce(lambda: \g<0>)"),
    Rule("reassign-guard", r"^( +)(?=self\.driver\.\w\(\)\.and_)", r"\1testing = lambda: True\n\1"),
    Rule("may-not-run", r"^( +)(?=self\.driver\.\w\(\)\.and_)", r"\1if True:\n\1    return\n\1"),
    # Bound, and yet it never starts, or ends long before its time.
    *(
        Rule("never-starts", LAST_WAY, rf"\g<0>.{decorator}")
        for decorator in (
            "unless(lambda: True)",
            "onlyIf(lambda: False)",
            "onlyIf(lambda: 1 > 2)",
            "onlyWhile(lambda: not True)",
        )
    ),
    Rule("ends-early", LAST_WAY, r"\g<0>.withTimeout(0.1)"),
    Rule("ends-early", LAST_WAY, r"\g<0>.until(lambda: True)"),
    Rule("slow-trigger", r"\.and_\(testing\)", r"\g<0>.debounce(100)"),
    *(
        Rule("constant-guard", rf"= {ASKS}\n", f"= lambda: wpilib.DriverStation.isTest() {more}\n")
        for more in ("and False", "or True", "and not True")
    ),
    Rule("constant-guard", r"\.and_\(testing\)", r"\g<0>.and_(lambda: False)"),
    *(
        Rule("clear-bindings", r"^ +self\.subsystem\.dynamic\(SysIdRoutine\.Direction\.kReverse\)\n( +)\)\n", rf"\g<0>\1from commands2 import CommandScheduler\n\1{SCHEDULER}.{loop}().clear()\n")
        for loop in ("getDefaultButtonLoop", "getActiveButtonLoop")
    ),
    Rule("other-button", r"(?<=driver)\.[abxy]\(\)", ".a()"),
    Rule("other-button", r"(?<=driver)\.[abxy]\(\)", ".b()"),
    Rule("other-test", r"(?<=\.)quasistatic\(", "dynamic("),
    Rule("other-test", r"(?<=\.)dynamic\(", "quasistatic("),
    Rule("fixed-direction", r"(?<=c\()direction\)", "SysIdRoutine.Direction.kForward)"),
    Rule("hide-method", r"(?<=def )(?=quasistatic|dynamic)", "_"),
    Rule("never-bind", r"^ +self\.configure_bindings\(\)\n", ""),
    Rule("wrong-comment", r"(?<=# )Quasistatic", "Dynamic", comments=True),
    Rule("wrong-comment", r"(?<=# )Dynamic", "Quasistatic", comments=True),
    Rule("drop-comment", r"# (?:Quasistatic|Dynamic)[^\n]*", "#", comments=True),
    # Copied and not changed, left for right.
    Rule("swap-sides", r"\b(?:left|right)(?=\.|_|\b)", either("left", "right")),
    # Numbers that follow their unit, or do not.
    Rule("drop-conversion", r"^ +self\.\w+\.setDistancePerPulse\([^\n]*\n", ""),
    Rule("drop-conversion", r" \* METERS_PER_\w+", ""),
    Rule("double-conversion", r"(?<=getDistance\(\))|(?<=getRate\(\))", " * METERS_PER_PULSE"),
    Rule("double-conversion", r" \* (METERS_PER_\w+)", r"\g<0> * \1"),
    Rule("invert-conversion", r"(?<=PerPulse\()(?=\w)", "1 / "),
    Rule("invert-conversion", r" \* (METERS_PER_\w+)", r" / \1"),
    Rule("diameter-for-radius", r"math\.pi", "2 * math.pi"),
    Rule("angular-for-linear", r"(?<=\.)(?:position|velocity)(?=\()", lambda m: f"angular{m[0].title()}"),
    Rule("minutes-for-seconds", r"getRate\(\)", "getRate() * 60"),
    Rule("feet-for-meters", r"getDistance\(\)|getRate\(\)", r"\g<0> * 3.28084"),
    Rule("raw-pulses", r"getDistance", "getRaw"),
    Rule("raw-pulses", r"getDistance", "get"),
    # Signs, quantities, sources.
    Rule("flip-sign", r"(?<=\.voltage\()(?=self)", "-"),
    Rule("flip-sign", r"(?<=[ (])(?=self\.\w+_encoder\.get)", "-"),
    Rule("flip-sign", r"(?<=PerPulse\()", "-"),
    Rule("position-for-velocity", r"getDistance|getRate", either("getDistance", "getRate")),
    Rule("position-for-velocity", r"(?<=\.)(?:position|velocity)(?=\()", either("position", "velocity")),
    Rule("duty-for-voltage", r"(?<=voltage\(self\.)(\w+)\.getVoltage", r"\1.get"),
    Rule("nominal-battery", r"(?<=voltage\()self\.(\w+)\.getVoltage\(\)", r"self.\1.get() * 12.0"),
    Rule("velocity-for-voltage", r"(?<=voltage\()self\.(left|right)\.getVoltage", r"self.\1_encoder.getRate"),
    Rule("asked-voltage", r"(?<=voltage\()self\.\w+\.getVoltage\(\)", "self.asked"),
    # The voltage on its way.
    Rule("duty-cycle", SENT, "set(voltage / 12)"),
    Rule("duty-cycle", SENT, "set(voltage)"),
    Rule("scaled-voltage", SENT, "setVoltage(voltage / 12)"),
    Rule("scaled-voltage", SENT, "setVoltage(voltage * 2)"),
    Rule("scaled-voltage", SENT, "setVoltage(voltage + 0.2)"),
    Rule("constant-voltage", SENT, "setVoltage(3.5)"),
    Rule("constant-voltage", SENT, "setVoltage(0)"),
    Rule("clamp-voltage", SENT, "setVoltage(min(voltage, 2.0))"),
    Rule("one-way-voltage", SENT, "setVoltage(voltage if voltage > 0 else 0)"),
    Rule("one-way-voltage", SENT, "setVoltage(abs(voltage))"),
    Rule("stop-after", r"^( +self\.\w+\.)setVoltage\([^\n]*\n", r"\g<0>\1stopMotor()\n"),
    Rule("may-not-run", r"^( +)(?=self\.\w+\.setVoltage)", r"\1if voltage > 3:\n\1    return\n\1"),
    Rule("may-not-run", r"^( +)(?=self\.\w+\.setVoltage)", r"\1if voltage > 0: "),
    Rule("may-not-run", r"^( +)(?=log\.motor)", r"\1if True:\n\1    return\n\1"),
    Rule("lost-sign", r"(?<=[( ])self\.\w+\.get(?:Voltage|Distance|Rate)\(\)", r"abs(\g<0>)"),
    Rule("moves-in-periodic", r"\n\Z", PERIODIC.format("self.right.setVoltage(0)")),
    Rule("closed-loop", r"(?<=setVoltage\()voltage", "self.controller.calculate(0, voltage)"),
    Rule("stop-motor", SENT, "stopMotor()"),
    # Constants and arguments.
    Rule("swap-config", r"rampRate=(0\.5), stepVoltage=(3\.5)", r"rampRate=\2, stepVoltage=\1"),
    Rule("swap-config", r"stepVoltage=(3\.5), timeout=(10\.0)", r"stepVoltage=\2, timeout=\1"),
    Rule("misspell-keyword", r"rampRate|stepVoltage|timeout", without_a_letter),
    Rule("swap-callbacks", r"(self\.drive), (self\.record)", r"\2, \1"),
    Rule("swap-callbacks", r"(self\.record), (self)\b", r"\2, \1"),
    Rule("same-callback", r"self\.drive(?=,)", "self.record"),
    Rule("same-callback", r"self\.record(?=,)", "self.drive"),
    Rule("called-callback", r"(?<=Mechanism\()self\.drive", "self.drive()"),
    Rule("other-feedforward", r"(?<=\.feedforward = )\w+(?=\()", "ArmFeedforward"),
    Rule("null-argument", r"(?<=, )self(?=\))", "None"),
    Rule("null-argument", r"self\.(?:drive|record)(?=,)", "None"),
    Rule("null-argument", r"(?<=rampRate=)0\.5|(?<=stepVoltage=)3\.5", "None"),
    Rule("drop-argument", r", self(?=\))", ""),
    Rule("drop-argument", r"(?:rampRate|stepVoltage|timeout)=[\d.]+(?:, )?", ""),
    # Statements and declarations.
    Rule("drop-statement", r"^ {8,}self\.[^\n]*\n", lambda m: _indent(m[0]) + "pass\n"),
    Rule("drop-link", r"\.voltage\(self\.\w+\.getVoltage\(\)\)", ""),
    Rule("drop-link", r"\.(?:position|velocity)\(\s*self\.\w+\.get\w+\(\)\s*\)", ""),
    Rule("drop-motor", r"^ +log\.motor\((?:.|\n)*?getRate\(\)\)\n", "        pass\n"),
    Rule("drop-super", r"^ +super\(\)\.__init__\(\)\n", ""),
    Rule("no-subsystem", r"\(Subsystem\)(?=:)", ""),
    Rule("drop-self", r"(?<![\w.])self\.(?=left|right|driver\.|subsystem\.|routine\.)", ""),
    Rule("drop-unit", r"  # V[^\n]*", "", comments=True),
    Rule("other-unit", r"(?<=# )V·s(?:²)?/\w+", "V", comments=True),
    # Code that stops with an error.
    Rule("drop-import", r"^(?:import|from) [^\n]*\n", ""),
    Rule("misspell-import", r"^from [\w.]+ import \w{5,}", without_a_letter),
    Rule("misspell-class", r"(?<![\w.\"])(?=[A-Z]\w{5,})(?![A-Z_]+\b)\w+", without_a_letter),
    Rule("misspell-variable", r"(?<=self\.)\w{4,}(?=[.,)])", without_a_letter),
    Rule("misspell-constant", r"(?<=\()[A-Z]+_PER_[A-Z]+\b", without_a_letter),
    *COMMON,
)  # fmt: skip


def _indent(line: str) -> str:
    return line[: len(line) - len(line.lstrip())]


def changes_of(text: str) -> Iterator[tuple[str, int, str]]:
    """Operator, line and text of every mutant of a Python file."""
    return all_changes(RULES, text, comment=COMMENT)
