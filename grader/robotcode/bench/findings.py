"""What a run shows to be wrong, in words and with its figures; None where nothing is."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from grader.robotcode.bench.run_facts import (
    ButtonPress,
    DrivenMotor,
    LoggedMotor,
    RunFacts,
    RunOutcome,
)
from grader.robotcode.bench.run_routine_child import BATTERY, METERS_PER_PULSE

IN = "in WPILib's simulation"
CLOSE = 0.02  # of a number that was asked for; a PWM signal comes in steps of some 20 mV
NEAR = 0.005  # of a slip's factor
SLIPS = {  # what a velocity is of the slope of its position, and how that comes about
    60.0: "One is per minute, the other per second",
    1 / 60: "One is per minute, the other per second",
    2 * math.pi: "One is in radians, the other in rotations",
    1 / (2 * math.pi): "One is in radians, the other in rotations",
    360.0: "One is in degrees, the other in rotations",
    1 / 360: "One is in degrees, the other in rotations",
    180 / math.pi: "One is in degrees, the other in radians",
    math.pi / 180: "One is in degrees, the other in radians",
}


@dataclass(frozen=True)
class RunFault:
    """A fault in the code that its run shows.

    Args:
        seen: what happened, with figures.
        hint: likely cause and next step.
        misconception: its code, or empty.
        share: of the check's points that are lost.
    """

    seen: str
    hint: str
    misconception: str = ""
    share: float = 1.0


def find_stop(ran: RunFacts, *, where: str) -> RunFault | None:
    """A fault if the code raised an error, or never ended.

    Args:
        ran: the run.
        where: the callback that is asked about, ``drive`` or ``log``; empty is all the rest.
    """
    if ran.outcome not in {RunOutcome.CRASHED, RunOutcome.ENDLESS} or ran.where != where:
        return None
    hint = f"The program stopped there {IN}. Fix that line, and grade again."
    return RunFault(ran.said, hint)


def check_setting(
    got: float, wanted: float, *, said: str, unit: str, advice: str, within: float = 1e-6
) -> RunFault | None:
    """A fault if a number of the Config is not what the exercise asks for.

    Args:
        got: what the run showed, in SI.
        wanted: what the exercise asks for.
        said: what happened: ``the ramp rose by``.
        unit: its symbol.
        advice: how to put it right.
        within: how much it may be off, in SI.
    """
    if math.isclose(got, wanted, rel_tol=1e-6, abs_tol=within):
        return None
    value = f"{got:.4g} {unit}" if math.isfinite(got) else "no end"
    return RunFault(f"{IN} {said} {value}", advice)


def check_driven_motors(ran: RunFacts) -> RunFault | None:
    """A fault if a motor got another voltage than the tests commanded."""
    wrong = [(motor, fault) for motor in ran.motors if (fault := _driven(motor))]
    if not wrong:
        return None
    seen, hint, misconception = wrong[0][1]
    return RunFault(seen, hint, misconception, len(wrong) / len(ran.motors))


def _driven(motor: DrivenMotor) -> tuple[str, str, str] | None:
    if (
        motor.share is None
        or abs(abs(motor.share) - 1.0) < CLOSE
        or (motor.share and not motor.own)
    ):
        return None
    if not motor.share:
        hint = "Drive every motor. The others have to turn one that gets no voltage, and kS and kA "
        hint += "become too large."
        return f"{IN} {motor.name} never gets a voltage", hint, ""
    seen = f"{IN} {motor.name} got {motor.got:.2f} V when the test asked for {motor.asked:.2f} V"
    for nominal in (12.0, 12.5, 13.0):
        if abs(abs(motor.share) * nominal / BATTERY - 1.0) < CLOSE / 2:
            hint = f"A share of {nominal:g} V is not a voltage. Pass the voltage to setVoltage()."
            return f"{seen}: the battery had {BATTERY:g} V", hint, "M-DUTY"
    return seen, "Your code changes the voltage. Send it unchanged: setVoltage(voltage).", ""


def check_logged_motors(ran: RunFacts, *, demanded: int = 0) -> RunFault | None:
    """A fault if a logged voltage is not what the motor got.

    Args:
        ran: the run.
        demanded: how many of the motors that were driven have to be in the log.
    """
    if ran.lacking:
        return RunFault(f"{IN} the log cannot be read: {ran.lacking}", "Record all three signals.")
    moved = sum(bool(motor.share) for motor in ran.motors)
    if ran.recorded and len(ran.recorded) < min(demanded, moved):
        seen = f"{IN} {moved} motors are driven, and the log has {len(ran.recorded)} of them"
        hint = "Each side has its own friction: record every motor, each under its own name."
        return RunFault(seen, hint, "", 1 - len(ran.recorded) / moved)
    mirrored = any((motor.share or 0) < 0 for motor in ran.motors)  # whose sign is whose, who knows
    for one in ran.recorded:
        fault = _voltage(one) or (None if mirrored else _sign(one))
        if fault:
            return fault
    names = [one.name for one in ran.recorded]
    eyes = [one.encoder for one in ran.recorded if one.encoder is not None]
    if len(eyes) == len(names) == len(ran.per_pulse) > len({*eyes}):
        twice = [one.name for one in ran.recorded if eyes.count(one.encoder or 0) > 1]
        hint = "Record for each motor the reading of its own encoder."
        return RunFault(f"{IN} {' and '.join(twice)} record the same encoder", hint, "", 1 / 3)
    return None


def _voltage(one: LoggedMotor) -> RunFault | None:
    advice = "Log the voltage that the motor got: in Python, getVoltage() of the motor."
    off = abs(one.kept - one.lowered) > CLOSE * abs(one.lowered)
    if one.as_asked or (one.voltage and off and abs(one.voltage - 1.0) < CLOSE):
        low = f"the motor got {one.lowered:.2f} V, and the log says {one.kept:.2f} V"
        seen = (
            f"{IN}, with a weak battery, {low}"
            if off
            else f"{IN} the log has the commanded voltage"
        )
        return RunFault(f"{seen} ({one.name})", advice, "M-CMDVOLT", 1 / 2)
    if one.voltage is not None and abs(one.voltage - 1.0) > CLOSE:
        seen = f"{IN} the voltage in the log is {one.voltage:.3g} times that of {one.name}"
        return RunFault(seen, advice, "", 1 / 2)
    return None


def _sign(one: LoggedMotor) -> RunFault | None:
    if one.forward is False:
        hint = "Invert the encoder, or what is logged, so that both signs agree."
        seen = f"{IN} a positive voltage of {one.name} gives a negative velocity"
        return RunFault(seen, hint, "", 1 / 3)
    return None


def check_logged_units(ran: RunFacts) -> RunFault | None:
    """A fault if positions and velocities fit neither each other nor the bench's encoders."""
    return next(filter(None, _units(ran)), None)


def _units(ran: RunFacts) -> Iterator[RunFault | None]:
    for one in ran.recorded:
        yield _rate(one)
        if one.encoder is not None and ran.per_pulse[one.encoder] == METERS_PER_PULSE:
            yield _scale(one)


def _rate(one: LoggedMotor) -> RunFault | None:
    if one.rate is None or abs(one.rate - 1.0) < CLOSE:
        return None
    seen = f"{IN} the velocity of {one.name} is {one.rate:.3g} times the slope of its position"
    if abs(one.rate + 1.0) < CLOSE:
        return RunFault(seen, "One of the two has the wrong sign.")
    slip = _slip(abs(one.rate)) or "They are in different units"
    return RunFault(seen, f"{slip}. Choose one unit, and the same per second.", "M-UNITS")


def _scale(one: LoggedMotor) -> RunFault | None:
    """An encoder of the exercise's own drivetrain counts meters: so must the log."""
    if one.scale is None or (abs(abs(one.scale) - 1.0) < CLOSE and not one.angular):
        return None
    seen = f"{IN} {one.name} moved 1 m, and the log says {abs(one.scale):.4g}"
    unit = "rotations" if one.angular else "meters"
    return RunFault(
        f"{seen} {unit}", "The encoders count meters: log their readings unchanged.", "M-UNITS"
    )


def _slip(factor: float) -> str:
    return next((said for slip, said in SLIPS.items() if abs(factor / slip - 1) < NEAR), "")


def check_requirements(ran: RunFacts) -> RunFault | None:
    """A fault if the tests do not require the subsystem that they drive."""
    if ran.required:
        return None
    hint = "Pass self after the two callbacks. Then nothing else moves the motors during a test."
    return RunFault(f"{IN} the tests do not require the subsystem they drive", hint)


def check_release(ran: RunFacts) -> RunFault | None:
    """A fault if a test goes on when its button is released."""
    for one in ran.presses:
        if one.stayed:
            hint = (
                "A test must stop when you release the button: pass the test itself to whileTrue()."
            )
            return RunFault(
                f"{IN} {_of(one)} continued after the button was released", hint, "", 2 / 3
            )
    return None


def check_guard(ran: RunFacts) -> RunFault | None:
    """A fault if a button starts a test while the robot is driven."""
    for one in ran.presses:
        if not one.test_mode:
            hint = "The guard does not stop it. Check test mode each time a button is pressed."
            return RunFault(f"{IN}, outside of test mode, {_of(one)} ran", hint)
    return None


def _of(one: ButtonPress) -> str:
    tests = " and ".join(test.replace("-", " ") for test in one.tests)
    return f"the {tests} test of button {one.button} (controller {one.port})"


def format_figures(ran: RunFacts) -> str:
    """The numbers of a run as one line of text."""
    ends = f"{ran.timeout:.4g} s" if math.isfinite(ran.timeout) else "no end"
    return f"{ran.ramp:.4g} V/s, {ran.step:.4g} V, {ends}"
