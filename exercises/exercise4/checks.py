"""Exercise 4: is this SysIdRoutine wired the way SysId needs it? Read from the text, never run."""

from pathlib import Path

from grader import robotcode
from grader.check import NotReached, Wrong, check
from grader.robotcode.facts import RoutineFacts
from grader.submission import read_text
from grader.wiring import (
    Setting,
    cannot_tell,
    check_driven,
    check_open_loop,
    check_recorded,
    check_units,
)
from sim.errors import UnreadableFile

FILES = ("ExampleSubsystem.java", "example_subsystem.py")

RAMP = Setting(
    "ramp", 0.5, "V/s", "volts-per-second", 1.0, "Volts.of(0.5).per(Second)", "rampRate=0.5"
)
STEP = Setting("step voltage", 3.5, "V", "volts", 7.0, "Volts.of(3.5)", "stepVoltage=3.5")
TIMEOUT = Setting("timeout", 10.0, "s", "seconds", 10.0, "Seconds.of(10)", "timeout=10.0")
NEEDED = ("voltage", "position", "velocity")  # of every motor
LESSON_STEP = 3.0  # [V] in the source lesson's example


def read(path: Path, *, student: str) -> RoutineFacts:  # noqa: ARG001 - one task for everyone
    """What the file says about its routine.

    Raises:
        UnreadableFile: it cannot be read, or does not parse.
    """
    read_text(path)
    facts = robotcode.read(path)
    if facts.problems:
        first = facts.problems[0]
        raise UnreadableFile(
            first.message,
            where=f"{path}, line {first.line}",
            advice="Mend that line first: code with a mistake like this does not compile.",
        )
    return facts


@check(points=1)
def routine(facts: RoutineFacts) -> None:
    """Your subsystem makes a SysIdRoutine."""
    if not facts.routine_line:
        raise Wrong(
            f"no SysIdRoutine in {facts.class_name or 'this file'}",
            hint="Make one where the motors are made, and keep it in a field.",
        )


@check(points=1, after=routine)
def ramp(facts: RoutineFacts) -> str | None:
    """The quasistatic test raises the voltage by 0.5 V every second."""
    return RAMP.compare(facts, facts.ramp, advice=_about_ramp)


def _about_ramp(value: float) -> tuple[str, str]:
    if 0 < value < RAMP.value:
        return "Slower is not safer.", "M-SLOW-SAFE"
    return "", ""


@check(points=1, after=routine)
def step(facts: RoutineFacts) -> str | None:
    """The dynamic test applies a step of 3.5 V."""
    return STEP.compare(facts, facts.step, advice=_about_step)


def _about_step(value: float) -> tuple[str, str]:
    if value == LESSON_STEP:
        return "3 V is the lesson's own example, and no mistake in itself.", ""
    if value >= STEP.default:
        return "7 V, WPILib's default, is almost always too much.", "M-BIG-STEP"
    return "", ""


@check(points=1, after=routine)
def timeout(facts: RoutineFacts) -> str | None:
    """A test ends by itself after 10 s."""
    return TIMEOUT.compare(facts, facts.timeout)


@check(points=3, after=routine)
def drive(facts: RoutineFacts) -> str | None:
    """The drive callback sends its voltage to every motor, as a voltage."""
    motors = list(dict.fromkeys([*facts.motors, *(call.motor for call in facts.drive)]))
    _followed(facts, whole={call.motor for call in facts.drive} >= {*motors} > set())
    if not facts.drive:
        raise Wrong(
            "the drive callback moves no motor" if facts.drive_found else "no drive callback",
            hint="It gets the voltage of the test: hand it to setVoltage() of every motor.",
        )
    wrong: list[Wrong] = []
    for motor in motors:
        try:
            check_driven(motor, facts.drive)
        except Wrong as why:
            wrong.append(why)
    if wrong:
        wrong[0].earned = round(3 * (1 - len(wrong) / len(motors)), 1)
        raise wrong[0]
    if any(call.method in {"setControl", "set_control"} for call in facts.drive):
        return "setVoltage() sends a VoltageOut, too. Keep one request object and reuse it."
    return None


def _followed(facts: RoutineFacts, *, whole: bool) -> None:
    """Ask, where something is missing that may be in code out of sight."""
    if facts.unread and not whole:
        first = facts.unread[0]
        raise Wrong(
            f"line {first.line}: {first.message}",
            hint="Write the callback where it can be read: in this class, or in this folder.",
        )


@check(points=3, after=routine)
def log(facts: RoutineFacts) -> None:
    """The log callback records the motor's name, position, velocity and applied voltage."""
    if facts.log_is_null:
        raise Wrong(
            "null in place of the log callback: then WPILib records nothing",
            hint="That is for vendors' own loggers. Here, write a callback that fills the log.",
        )
    motors = dict.fromkeys(one.motor for one in facts.logged)
    recorded = {(one.motor, one.signal) for one in facts.logged}
    needed = {(motor, signal) for motor in motors for signal in NEEDED}
    _followed(facts, whole=recorded >= needed > set())
    if not facts.logged:
        raise Wrong(
            "the log callback records nothing" if facts.log_found else "no log callback",
            hint='It gets a log: log.motor("left"), then voltage, position and velocity.',
        )
    for motor in motors:
        check_recorded(motor, [one for one in facts.logged if one.motor == motor], points=3)


@check(points=2, after=routine)
def units(facts: RoutineFacts) -> None:
    """Position and velocity are in units that fit each other and the mechanism."""
    signals = [one for one in facts.logged if one.signal in {"position", "velocity"}]
    if not signals:
        raise NotReached("looked at once position and velocity are recorded")
    check_units(signals, mechanism=facts.class_name)


@check(points=1, after=routine)
def assembled(facts: RoutineFacts) -> None:
    """The parts are in their places: Config, Mechanism, and the subsystem itself."""
    this = "this" if facts.language == "java" else "self"
    if facts.config_argument > 0 or facts.mechanism_argument == 0:
        raise Wrong(
            f"the SysIdRoutine in line {facts.routine_line} gets its arguments in another order",
            hint="First the Config, then the Mechanism.",
            misconception="M-ARGORDER",
        )
    if facts.config_argument < 0 or facts.mechanism_argument < 0:
        part = "Config" if facts.config_argument < 0 else "Mechanism"
        raise Wrong(f"the SysIdRoutine gets no {part}", hint=f"Give it a SysIdRoutine.{part}.")
    if facts.subsystem_passed is None:
        raise Wrong(
            cannot_tell("which subsystem the Mechanism gets", ""),
            hint=f"Pass {this}: the tests have to require the subsystem they drive.",
        )
    if not facts.subsystem_passed:
        raise Wrong(
            f"no {this} among the Mechanism's arguments",
            hint=f"Pass {this} after the two callbacks. Then no other command can move the motors "
            "during a test.",
        )
    if not facts.is_subsystem:
        raise Wrong(
            f"{facts.class_name} is not a subsystem",
            hint="Let it extend SubsystemBase (Python: Subsystem).",
        )


@check(points=2, after=routine)
def open_loop(facts: RoutineFacts) -> None:
    """The drive callback uses no closed loop and no duty cycle."""
    if not facts.drive:
        raise NotReached("looked at once the drive callback moves a motor")
    for call in facts.drive:
        check_open_loop(call)
