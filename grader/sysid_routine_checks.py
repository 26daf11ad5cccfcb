"""What is right and what is wrong about a SysIdRoutine's wiring, in words for the learner.

Every function looks at facts read from robot code, and raises WrongAnswer where they are wrong, or
where they cannot be told by reading: then it asks, and never guesses.
"""

import math
import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

from grader.check import NotReachedError, WrongAnswer
from grader.robotcode.facts import (
    Certainty,
    ConfigQuantity,
    DriveCall,
    LoggedSignal,
    Output,
    ParseProblem,
    RoutineFacts,
    Source,
)

LINEAR = ("drive", "chassis", "swerve", "tank", "elevator", "lift", "climb", "telescop", "slide")
ANGULAR = ("arm", "shooter", "flywheel", "turret", "intake", "wrist", "pivot", "hood", "roller")
LENGTHS = ("meter", "inch", "feet", "foot", "radian", "degree", "rotation", "turn", "revolution")
SAME_LENGTH = {"feet": "foot", "turn": "rotation", "revolution": "rotation"}

# What makes a share of the battery of a voltage.
BATTERY = re.compile(r"/ ?1[0-3](\.\d*)?\b|\.(div|divide)\(|attery", re.IGNORECASE)

DECIMAL_COMMA = re.compile(r"\(\s*\d+\s*,\s*\d+\s*\)")  # Volts.of(0,5)
BATTERY_VOLTAGE = re.compile(r"(supply|battery|bus)_?voltage", re.IGNORECASE)
PRODUCT = re.compile(r"\*|times\(|multiply|dutycycle|duty_cycle|applied", re.IGNORECASE)

Advice = Callable[[float], tuple[str, str]]


def give_no_advice(_value: float) -> tuple[str, str]:
    """No advice: for a number without a typical mistake."""
    return "", ""


@dataclass(frozen=True)
class ConfigSetting:
    """A number of the Config, as an exercise asks for it.

    Args:
        name: in words: ``step voltage``.
        value: in SI.
        unit: its symbol.
        dimension: as in ``Quantity.dimension``.
        default: WPILib's own value.
        java, python: how to write it.
    """

    name: str
    value: float
    unit: str
    dimension: str
    default: float
    java: str
    python: str

    def compare(
        self, facts: RoutineFacts, got: ConfigQuantity, *, advice: Advice = give_no_advice
    ) -> str | None:
        """Compare the setting with the code.

        Args:
            facts: the code.
            got: the number in question.
            advice: a wrong value -> a sentence about it and the misconception behind it, or empty.

        Returns:
            A note where the number is right by default only.

        Raises:
            WrongAnswer: it is another number, or no such quantity, or cannot be told.
            NotReachedError: there is no Config.
        """
        if facts.config_argument < 0:
            raise NotReachedError("checked after the SysIdRoutine gets a Config")
        if got.text == "None":
            raise WrongAnswer(
                f"None for the {self.name}",
                hint="In Java null means WPILib's default. RobotPy stops with a TypeError when the "
                f"test begins. This exercise asks for {self._asked(facts)}.",
            )
        if got.text == "null" and got.known is Certainty.UNKNOWN:
            raise WrongAnswer(
                f"null for the {self.name}",
                hint="Commands v3 takes no null there: the program stops as it starts. This "
                f"exercise asks for {self._asked(facts)}.",
            )
        if got.known is Certainty.UNKNOWN:
            hint = "Write it as a number, or as a named constant in this folder."
            if DECIMAL_COMMA.search(got.text):
                hint = "In code a decimal number has a point, not a comma: 0.5."
            raise WrongAnswer(explain_doubt(f"the {self.name}", got.text), hint=hint)
        value = self.default if got.value is None else got.value
        right = math.isclose(value, self.value, rel_tol=1e-9)
        if got.known is Certainty.DEFAULT:
            seen = f"left to WPILib's default, {value:g} {self.unit}"
            if right:
                return f"This is {seen}. Write the number anyway: a default may change."
        else:
            self._check_dimension(got, facts)
            seen = f"{quote_code(got)}: {value:g} {self.unit}"
        if right:
            return None
        said, misconception = advice(value)
        if value == 0 and "/" in got.text:
            said = "Whole numbers divide to a whole number in Java: 1 / 2 is 0."
        hint = f"{said} This exercise asks for {self._asked(facts)}.".strip()
        raise WrongAnswer(seen, hint=hint, misconception=misconception)

    def _asked(self, facts: RoutineFacts) -> str:
        example = self.python if facts.language == "python" else self.java
        return f"{self.value:g} {self.unit}: {example}"

    def _check_dimension(self, got: ConfigQuantity, facts: RoutineFacts) -> None:
        plain = got.dimension == "number" and facts.language == "python"
        if got.dimension == self.dimension or plain:
            return
        hint = f"The {self.name} is in {self.unit}. Here it is {self._asked(facts)}."
        others = [one for one in (facts.ramp, facts.step, facts.timeout) if one is not got]
        swapped = self.dimension in {one.dimension for one in others}
        if swapped:
            hint += " Config takes the ramp first, then the step, then the timeout."
        raise WrongAnswer(
            f"{quote_code(got)}, which is not in {self.unit}",
            hint=hint,
            misconception="M-ARGORDER" if swapped else "M-UNITS",
        )


def check_motor_driven(motor: str, calls: Sequence[DriveCall]) -> None:
    """Raise ``WrongAnswer`` unless a motor gets the test's voltage.

    Args:
        motor: its name in the code.
        calls: every command in the drive callback.

    Raises:
        WrongAnswer: it does not; with why.
    """
    mine = [call for call in calls if call.motor == motor]
    if not mine:
        hint = "Drive every motor. The others have to turn one that gets no voltage, and kS and kA "
        hint += "become too large."
        raise WrongAnswer(f"{motor} gets no voltage", hint=hint)
    for call in mine:
        if call.condition:
            raise WrongAnswer(
                explain_doubt(f"when {motor} gets the voltage", f"behind `{call.condition}`"),
                hint="Send every voltage of the test, without a condition.",
            )
        hint, misconception = "Pass the voltage to setVoltage() unchanged.", ""
        if call.output is Output.VOLTAGE and call.uses_parameter and call.scaled is False:
            continue
        if call.output is Output.DUTY or BATTERY.search(call.text):
            misconception = "M-DUTY"
        elif call.output is Output.CLOSED_LOOP:
            misconception = "M-CLOSEDLOOP"
        elif call.output is Output.UNKNOWN or call.uses_parameter is None or call.scaled is None:
            raise WrongAnswer(
                explain_doubt(f"what {motor} gets", quote_code(call)), hint="Call setVoltage()."
            )
        elif not call.uses_parameter:
            hint = "That does not depend on the test. Send the voltage that the callback gets."
        else:
            hint = f"Your code changes the voltage. {hint}"
        raise WrongAnswer(quote_code(call), hint=hint, misconception=misconception)


def find_test_commands(facts: RoutineFacts) -> tuple[DriveCall, ...]:
    """The commands of the drive callback, without those that only hold another axis still.

    While a swerve drive goes straight, a closed loop holds its steering. It never sees the voltage
    of the test, and its motor is a module's, not one of the subsystem's own.
    """
    others = {call.motor for call in facts.drive if call.output is not Output.CLOSED_LOOP}
    holding = {
        call.motor
        for call in facts.drive
        if call.output is Output.CLOSED_LOOP
        and call.uses_parameter is False
        and call.motor not in {*facts.motors, *others}
    }
    return tuple(call for call in facts.drive if not others or call.motor not in holding)


def check_only_test_drives(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` if anything but the test moves its motors.

    Raises:
        WrongAnswer: periodic() commands one as well.
    """
    for call in facts.in_periodic:
        raise WrongAnswer(
            f"periodic() calls {quote_code(call)}",
            hint=f"It runs in every loop, also during a test, and changes the voltage of "
            f"{call.motor}. Let only commands drive the motors.",
        )


def check_open_loop(call: DriveCall) -> None:
    """Raise ``WrongAnswer`` unless a command passes the test's voltage on.

    Raises:
        WrongAnswer: it is a closed loop or a share of the battery, or it cannot be told.
    """
    if call.output is Output.DUTY:
        hint = "A test commands volts, so send volts: setVoltage(voltage), not divided."
        raise WrongAnswer(quote_code(call), hint=hint, misconception="M-DUTY")
    if call.output is Output.CLOSED_LOOP:
        hint = "Send the voltage unchanged, and use no controller in the test."
        raise WrongAnswer(quote_code(call), hint=hint, misconception="M-CLOSEDLOOP")
    if call.output is Output.UNKNOWN:
        raise WrongAnswer(
            explain_doubt("what this does", quote_code(call)), hint="Call setVoltage(voltage)."
        )


def check_motor_recorded(motor: str, signals: Sequence[LoggedSignal], *, points: float) -> None:
    """Raise ``WrongAnswer`` unless all signals that a fit needs of a motor are recorded.

    Args:
        motor: its name in the log; empty if it cannot be told.
        signals: what is recorded of it.
        points: for everything; half of it is the voltage's, the rest is shared evenly.

    Raises:
        WrongAnswer: something is missing, or the voltage is the one that was asked for.
    """
    there = {one.signal: one for one in signals}
    lacking = [name for name in ("voltage", "position", "velocity") if name not in there]
    of = f" of {motor}" if motor else ""
    earned = points * (1.0 - (not motor) / 6 - sum(_SHARE[name] for name in lacking))
    voltage = there.get("voltage")
    if voltage and voltage.source is Source.COMMANDED:
        raise WrongAnswer(
            f"{quote_code(voltage)}: the commanded voltage",
            hint=APPLIED,
            misconception="M-CMDVOLT",
            earned=earned - points * _SHARE["voltage"],
        )
    if hidden := next((one for one in signals if one.condition), None):
        raise WrongAnswer(
            explain_doubt(f"when {quote_code(hidden)} is reached", f"behind `{hidden.condition}`"),
            hint="Record every signal each time the callback is called.",
            earned=0.0,
        )
    if lacking:
        hint = "A fit needs all three of every motor: voltage, position and velocity."
        raise WrongAnswer(f"no {' and no '.join(lacking)}{of}", hint=hint, earned=earned)
    if voltage and voltage.source is Source.UNKNOWN:
        if BATTERY_VOLTAGE.search(voltage.text) and not PRODUCT.search(voltage.text):
            raise WrongAnswer(
                f"{quote_code(voltage)}: the voltage of the battery",
                hint=f"The motor gets only a part of it. {APPLIED}",
                earned=earned - points * _SHARE["voltage"],
            )
        raise WrongAnswer(
            explain_doubt(f"where the voltage{of} comes from", quote_code(voltage)),
            hint="Ask the motor itself for it, in the log callback.",
            earned=earned - points * _SHARE["voltage"],
        )
    if not motor:
        hint = 'Write it where you log it: log.motor("left").'
        raise WrongAnswer(
            explain_doubt("the motor's name", quote_code(signals[0])), hint=hint, earned=earned
        )


APPLIED = (
    "Log the voltage that the motor got: getMotorVoltage(), getAppliedOutput() times the bus "
    "voltage, or in Python getVoltage()."
)
_SHARE = {"voltage": 1 / 2, "position": 1 / 6, "velocity": 1 / 6}


def check_units(signals: Sequence[LoggedSignal], *, mechanism: str) -> None:
    """Raise ``WrongAnswer`` unless the units of position and velocity fit the mechanism.

    Args:
        signals: the positions and velocities that are recorded.
        mechanism: the class's name, which may tell how it moves.

    Raises:
        WrongAnswer: they do not, or no unit can be told.
    """
    seen = ", ".join(f"{s.signal} {_find_unit_kind(s)} (line {s.line})" for s in signals)
    families = {one.family for one in signals if one.family}
    if not families:
        raise WrongAnswer(
            explain_doubt("the units", seen), hint="Name the unit where you log the value."
        )
    lengths = {_find_length_unit(one.unit) for one in signals if one.unit}
    wanted = find_motion_family(mechanism)
    hint = ""
    if len(families) > 1:
        hint = "Some of these are lengths and others are angles. Choose one kind for all."
    elif len(lengths) > 1:
        hint = "Choose one unit for the position, and the same per second for the velocity."
    elif wanted and families != {wanted}:
        unit = "Meters" if wanted == "linear" else "Rotations or Radians"
        hint = f"By its name, {mechanism} moves in {unit}. Log it in {unit}."
    if hint:
        raise WrongAnswer(seen, hint=hint, misconception="M-UNITS")


def _find_unit_kind(signal: LoggedSignal) -> str:
    """The unit of a value, or where none is written, what kind of unit it has."""
    kinds = {"linear": "along a line", "angular": "as an angle"}
    return f"in {signal.unit}" if signal.unit else kinds.get(signal.family, "in an unknown unit")


def _find_length_unit(unit: str) -> str:
    """The length or angle in a unit's name: ``rotation`` of RotationsPerSecond."""
    name = unit.lower()
    if name == "rpm" or "minute" in name:
        return "rotation per minute"
    found = next((length for length in LENGTHS if length in name), name)
    return SAME_LENGTH.get(found, found)


def find_motion_family(name: str) -> str:
    """The motion of a mechanism of this name, ``linear`` or ``angular``; empty if unknown."""
    words = [word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)]
    linear = any(word.startswith(LINEAR) for word in words)
    angular = any(word.startswith(ANGULAR) for word in words)
    if linear == angular:
        return ""
    return "linear" if linear else "angular"


def check_compiles(errors: Sequence[ParseProblem], *, language: str, earned: float = 0.0) -> None:
    """Raise ``WrongAnswer`` if a compiler, or Python itself, would stop at an error.

    Args:
        errors: what it found.
        language: ``java`` or ``python``.
        earned: points all the same.

    Raises:
        WrongAnswer: it found something.
    """
    for one in errors:
        stops = "the code does not compile" if language == "java" else "Python stops with an error"
        more = f" There are {len(errors)} such lines." if len(errors) > 1 else ""
        raise WrongAnswer(
            f"line {one.line}: {one.message}",
            hint=f"With this line {stops}, and the robot does not start. "
            f"Correct {'the name' if one.meant else 'it'}.{more}",
            earned=earned,
        )


def check_spelling(
    errors: Sequence[ParseProblem],
    *,
    lines: Collection[int] | None = None,
    language: str,
    earned: float = 0.0,
) -> None:
    """Raise ``WrongAnswer`` if a misspelled name explains what another check misses.

    Args:
        errors: what a compiler, or Python itself, would stop at.
        lines: in which a misspelled name counts; None for all.
        language: ``java`` or ``python``.
        earned: points all the same.

    Raises:
        WrongAnswer: a name is misspelled.
    """
    misspelled = [one for one in errors if one.meant and (lines is None or one.line in lines)]
    check_compiles(misspelled, language=language, earned=earned)


READ = {  # what is said of code that nobody compiled
    "java": "Read, not compiled: build it once with WPILib before you trust it.",
    "python": "Read, not compiled, not run: RobotPy is not installed here.",
}


def quote_code(what: ConfigQuantity | DriveCall | LoggedSignal) -> str:
    """The code in question and its line, if it stands in the file in hand."""
    return f"{what.text} in {f'line {what.line}' if what.line else 'another file'}"


def explain_doubt(what: str, text: str) -> str:
    """A message that asks the learner about code that could not be interpreted."""
    return f"the grader cannot see {what} by reading{f' {text}' if text else ''}"
