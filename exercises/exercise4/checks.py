"""Exercise 4: is this SysIdRoutine wired the way SysId needs it? Read, and RobotPy run as well."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from grader import robotcode
from grader.check import NotReachedError, Status, WrongAnswer, check, run_checks
from grader.logged_numbers import (
    check_all_logged,
    check_circumference,
    check_constants,
    check_devices,
    check_logged_signs,
    check_numbers,
    check_signs,
    check_sources,
)
from grader.robotcode import bench
from grader.robotcode.bench import RunFacts, RunOutcome, findings
from grader.robotcode.bench.findings import RunFault, find_stop
from grader.robotcode.facts import Output, RoutineFacts
from grader.robotcode.vocabulary import CONFIG_DEFAULTS, SEASON
from grader.submission import read_text
from grader.sysid_routine_checks import READ as READ_ONLY
from grader.sysid_routine_checks import (
    Advice,
    ConfigSetting,
    check_compiles,
    check_motor_driven,
    check_motor_recorded,
    check_only_test_drives,
    check_open_loop,
    check_spelling,
    check_units,
    explain_doubt,
    find_test_commands,
    give_no_advice,
)
from sim.core.errors import UnreadableFile

from .settled import Code, asks, noted, settle

FILES = ("ExampleSubsystem.java", "example_subsystem.py")

WPILIB = CONFIG_DEFAULTS[SEASON]  # ramp, step, timeout where nothing is given
RAMP = ConfigSetting(
    "ramp", 0.5, "V/s", "volts-per-second", WPILIB[0], "Volts.of(0.5).per(Second)", "rampRate=0.5"
)
STEP = ConfigSetting(
    "step voltage", 3.5, "V", "volts", WPILIB[1], "Volts.of(3.5)", "stepVoltage=3.5"
)
TIMEOUT = ConfigSetting(
    "timeout", 10.0, "s", "seconds", WPILIB[2], "Seconds.of(10)", "timeout=10.0"
)
TASK = "ExampleSubsystem"  # the class of the exercise's own drivetrain, one motor on each side
SIDES = 2
METERS = {"METERS_PER_ROTATION": 0.0472, "METERS_PER_PULSE": 0.000156}  # as the files give them
NEEDED = ("voltage", "position", "velocity")  # of every motor
EXACT, LOOPS = 1e-6, 0.1  # [SI] how far a number of a run may be off; a timeout is seen in loops
LESSON_STEP = 3.0  # [V] in the source lesson's example


def read(path: Path, *, student: str, run: bool = True) -> Code:  # noqa: ARG001 - one task for all
    """What the file says about its routine, and what that does.

    RobotPy code is run once reading finds no mistake: half a second to see what it does, and
    nothing for code that has to be mended first.

    Args:
        path: the file.
        student: whose it is.
        run: whether to run it, where it can be.

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
            advice="Fix that line first: code with a mistake like this does not compile.",
        )
    if facts.language == "python":
        bench.refuse_tampering(path)
    code = Code(facts)
    if run and facts.language == "python" and bench.is_robotpy_installed() and not _mistaken(code):
        return Code(facts, bench.run_sysid_routine(path, facts.class_name))
    return code


def _mistaken(code: Code) -> bool:
    """Whether reading alone finds a mistake; a question is none."""
    checks = (routine, ramp, step, timeout, drive, log, units, assembled, open_loop)
    results = run_checks(checks, code)
    return any(one.status is Status.FAILED and not asks(one.seen) for one in results)


@check(points=1)
def routine(code: Code) -> str | None:
    """Your subsystem makes a SysIdRoutine."""
    if not code.facts.routine_line:
        _spelled(code.facts)
        raise WrongAnswer(
            f"no SysIdRoutine in {code.facts.class_name or 'this file'}",
            hint="Make one where the motors are made, and keep it in a field.",
        )
    if code.facts.language == "java" or not bench.is_robotpy_installed():
        return READ_ONLY[code.facts.language]
    return noted(code.ran, findings.format_figures)


def _number(
    code: Code, wanted: ConfigSetting, said: str, *, advice: Advice = give_no_advice
) -> str | None:
    """One number of the Config: as it is written, and as the run shows it."""
    name = wanted.name.split()[0]
    got = getattr(code.facts, name)

    def running(ran: RunFacts) -> RunFault | None:
        return findings.check_setting(
            getattr(ran, name),
            wanted.value,
            said=said,
            unit=wanted.unit,
            advice=f"This exercise asks for {wanted.value:g} {wanted.unit}: {wanted.python}.",
            within=LOOPS if wanted is TIMEOUT else EXACT,
        )

    reading = partial(wanted.compare, code.facts, got, advice=advice)
    return settle(code, reading, _when_done(running), points=1)


def _when_done(
    running: Callable[[RunFacts], RunFault | None],
) -> Callable[[RunFacts], RunFault | None]:
    """Only a run that came to its end shows figures."""
    return lambda ran: running(ran) if ran.outcome is RunOutcome.RAN else None


@check(points=1, after=routine)
def ramp(code: Code) -> str | None:
    """The quasistatic test raises the voltage by 0.5 V every second."""
    return _number(code, RAMP, "the ramp rose by", advice=partial(_about_ramp, code.facts))


def _about_ramp(facts: RoutineFacts, value: float) -> tuple[str, str]:
    if (value, facts.step.value) == (STEP.value, RAMP.value):
        return "Ramp and step are swapped: the ramp comes first.", "M-ARGORDER"
    if 0 < value < RAMP.value:
        return "Slower is not safer.", "M-SLOW-SAFE"
    return "", ""


@check(points=1, after=routine)
def step(code: Code) -> str | None:
    """The dynamic test applies a step of 3.5 V."""
    return _number(code, STEP, "the step was", advice=_about_step)


def _about_step(value: float) -> tuple[str, str]:
    if value == LESSON_STEP:
        return "3 V is an example in many lessons, and fine on many robots.", ""
    if value >= STEP.default:
        return f"{STEP.default:g} V, WPILib's default, is almost always too much.", "M-BIG-STEP"
    return "", ""


@check(points=1, after=routine)
def timeout(code: Code) -> str | None:
    """A test ends by itself after 10 s."""
    return _number(code, TIMEOUT, "a test that nobody stopped ended after")


@check(points=3, after=routine)
def drive(code: Code) -> str | None:
    """The drive callback sends its voltage to every motor, as a voltage."""
    running = _either("drive", findings.check_driven_motors)
    return settle(code, partial(_drive, code.facts), running, points=3, answered=_undivided)


def _either(
    where: str, running: Callable[[RunFacts], RunFault | None]
) -> Callable[[RunFacts], RunFault | None]:
    """What a run shows, or where it stopped."""
    return lambda ran: find_stop(ran, where=where) or _when_done(running)(ran)


def _undivided(ran: RunFacts) -> bool:
    """Whether every motor was seen to get the voltage of the test."""
    told = all(motor.share is not None for motor in ran.motors)
    return told and findings.check_driven_motors(ran) is None


def _drive(facts: RoutineFacts) -> str | None:
    commands = find_test_commands(facts)
    motors = list(dict.fromkeys([*facts.motors, *(call.motor for call in commands)]))
    _followed(facts, whole={call.motor for call in commands} >= {*motors} > set())
    if not facts.drive:
        raise WrongAnswer(
            "the drive callback moves no motor" if facts.drive_found else "no drive callback",
            hint="It gets the voltage of the test: pass it to setVoltage() of every motor.",
        )
    wrong: list[WrongAnswer] = []
    for motor in motors:
        try:
            check_motor_driven(motor, commands)
        except WrongAnswer as why:
            wrong.append(why)
    if wrong:
        wrong[0].earned = round(3 * (1 - len(wrong) / len(motors)), 1)
        _spelled(facts, lines=_unclear(facts), earned=wrong[0].earned)
        raise wrong[0]
    check_only_test_drives(facts)
    check_numbers(facts)
    note = check_signs(facts, points=3, mirrored=facts.class_name != TASK)
    if note:
        return note
    if any(call.method in {"setControl", "set_control"} for call in facts.drive):
        return "setVoltage() sends a VoltageOut, too. Keep one request object and reuse it."
    return None


def _unclear(facts: RoutineFacts) -> set[int]:
    """The lines of the drive callback whose command is of no known kind."""
    return {call.line for call in facts.drive if call.output is Output.UNKNOWN}


def _spelled(facts: RoutineFacts, *, lines: set[int] | None = None, earned: float = 0.0) -> None:
    """Name a misspelled name before what it leads to."""
    check_spelling(facts.compile_errors, lines=lines, language=facts.language, earned=earned)


def _sent_by_log(facts: RoutineFacts) -> int:
    """The line in which the log callback sends a voltage; 0 if it does not."""
    if facts.drive or facts.logged or not (facts.drive_found and facts.log_found):
        return 0
    return next(
        (
            one.line
            for one in facts.unread
            if any(f"{motor}.setVoltage(" in one.message for motor in facts.motors)
        ),
        0,
    )


def _followed(facts: RoutineFacts, *, whole: bool) -> None:
    """Say that the callbacks are swapped, or ask where something may be in code out of sight."""
    if line := _sent_by_log(facts):
        raise WrongAnswer(
            f"line {line}, in the log callback, sends a voltage",
            hint="Are the two callbacks swapped? The Mechanism takes first the one that gets the "
            "voltage, then the one that gets the log.",
            misconception="M-ARGORDER",
        )
    if facts.unread and not whole:
        first = facts.unread[0]
        raise WrongAnswer(
            explain_doubt("all of the callback", f"line {first.line}: {first.message}"),
            hint=(
                "Write the callback in this class or in this folder, so that the grader can "
                "read it."
            ),
        )


@check(points=3, after=routine)
def log(code: Code) -> str | None:
    """The log callback records the motor's name, position, velocity and applied voltage."""
    demanded = SIDES if code.facts.class_name == TASK else 0
    running = _either("log", partial(findings.check_logged_motors, demanded=demanded))
    reading = partial(_log_spelled, code.facts, demanded)
    return settle(code, reading, running, points=3, answered=_held)


def _held(ran: RunFacts) -> bool:
    """Whether every motor in the log could be held against a motor of the bench."""
    return bool(ran.recorded) and all(one.voltage and one.lowered for one in ran.recorded)


def _log_spelled(facts: RoutineFacts, demanded: int) -> None:
    """What is recorded; a misspelled name outside the drive callback is told first."""
    try:
        _log(facts, demanded)
    except WrongAnswer as wrong:
        elsewhere = {one.line for one in facts.compile_errors} - _unclear(facts)
        _spelled(facts, lines=elsewhere, earned=wrong.earned)
        raise


def _log(facts: RoutineFacts, demanded: int) -> None:
    if facts.log_is_null and facts.language == "python":
        raise WrongAnswer(
            "None in place of the log callback: RobotPy stops with a TypeError in the first loop",
            hint="Where a vendor's logger records the motors, write `lambda log: None`. Here, "
            "write a callback that fills the log.",
        )
    if facts.log_is_null:
        raise WrongAnswer(
            "null instead of the log callback: then WPILib records nothing",
            hint=(
                "null is for the loggers of CTRE and REV. Here, write a callback that fills "
                "the log."
            ),
        )
    motors = dict.fromkeys(one.motor for one in facts.logged)
    recorded = {(one.motor, one.signal) for one in facts.logged}
    needed = {(motor, signal) for motor in motors for signal in NEEDED}
    _followed(facts, whole=recorded >= needed > set())
    if not facts.logged:
        raise WrongAnswer(
            "the log callback records nothing" if facts.log_found else "no log callback",
            hint='It gets a log: log.motor("left"), then voltage, position and velocity.',
        )
    for motor in motors:
        check_motor_recorded(motor, [one for one in facts.logged if one.motor == motor], points=3)
    check_devices(facts, points=3)
    check_all_logged(facts, demanded=demanded, points=3)
    check_logged_signs(facts.logged)


@check(points=2, after=routine)
def units(code: Code) -> str | None:
    """Position and velocity are in units that fit each other and the mechanism."""
    running = _when_done(findings.check_logged_units)
    return settle(code, partial(_units, code.facts), running, points=2, answered=_moved)


def _moved(ran: RunFacts) -> bool:
    return bool(ran.recorded) and all(one.rate for one in ran.recorded)


def _units(facts: RoutineFacts) -> None:
    signals = [one for one in facts.logged if one.signal in {"position", "velocity"}]
    if not signals:
        raise NotReachedError("checked after you record position and velocity")
    task = facts.class_name == TASK
    check_units(signals, mechanism="Drivetrain" if task else facts.class_name)
    check_sources(signals, geared=facts.geared)
    check_circumference(facts)
    if task:
        check_constants(facts, METERS)


@check(points=1, after=routine)
def assembled(code: Code) -> str | None:
    """The parts are in their places: Config, Mechanism, and the subsystem itself."""
    running = _either("", findings.check_requirements)
    return settle(code, partial(_assembled, code.facts), running, points=1)


def _assembled(facts: RoutineFacts) -> None:
    this = "this" if facts.language == "java" else "self"
    if facts.config_argument > 0 or facts.mechanism_argument == 0:
        raise WrongAnswer(
            f"the SysIdRoutine in line {facts.routine_line} gets its arguments in another order",
            hint="First the Config, then the Mechanism.",
            misconception="M-ARGORDER",
        )
    if facts.config_argument < 0 or facts.mechanism_argument < 0:
        part = "Config" if facts.config_argument < 0 else "Mechanism"
        raise WrongAnswer(
            f"the SysIdRoutine gets no {part}", hint=f"Give it a SysIdRoutine.{part}."
        )
    if facts.subsystem_passed is None:
        raise WrongAnswer(
            explain_doubt("which subsystem the Mechanism gets", ""),
            hint=f"Pass {this}: the tests must require the subsystem that they drive.",
        )
    if not facts.subsystem_passed:
        raise WrongAnswer(
            f"no {this} among the Mechanism's arguments",
            hint=f"Pass {this} after the two callbacks. Then no other command can move the motors "
            "during a test.",
        )
    if not facts.is_subsystem:
        raise WrongAnswer(
            f"{facts.class_name} is not a subsystem",
            hint="Let it extend SubsystemBase (Python: Subsystem).",
        )
    if facts.routine_lost:
        empty = "null" if facts.language == "java" else "None"
        raise WrongAnswer(
            f"line {facts.routine_lost} sets the field of the SysIdRoutine to {empty}",
            hint="Then there is no routine, and no test can start. Remove that line.",
        )
    check_compiles(facts.compile_errors, language=facts.language)


@check(points=2, after=routine)
def open_loop(code: Code) -> str | None:
    """The drive callback uses no closed loop and no duty cycle."""
    running = _when_done(_as_a_share)
    return settle(code, partial(_open_loop, code.facts), running, points=2, answered=_undivided)


def _as_a_share(ran: RunFacts) -> RunFault | None:
    fault = findings.check_driven_motors(ran)
    return fault if fault and fault.misconception else None


def _open_loop(facts: RoutineFacts) -> None:
    if not facts.drive:
        raise NotReachedError("checked after the drive callback moves a motor")
    _spelled(facts, lines=_unclear(facts))
    for call in find_test_commands(facts):
        check_open_loop(call)
