"""What is right and wrong about a SysIdRoutine, judged by what it did on the bench.

Every function looks at facts and raises WrongAnswer where they show a fault; where the facts depend
on something that nobody knows, it asks. What the robot did comes first, then the line that did it.
"""

import itertools
import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from grader.check import NotReachedError, WrongAnswer
from grader.robotcode.bench.facts import (
    DeviceFacts,
    Driven,
    Outcome,
    RoutineFacts,
    Sent,
    Setting,
    Signal,
    Stop,
    TestRun,
)
from grader.robotcode.library.world import GEARING
from grader.robotcode.problems import ParseProblem

DRIVES = ("drive", "chassis", "swerve", "tank")
LINEAR = (*DRIVES, "elevator", "lift", "climb", "telescop", "slide")
SHOOTERS = ("shooter", "flywheel")  # top and bottom turn on their own; left and right are one shaft
ANGULAR = (
    *(*SHOOTERS, "roller", "intake", "outtake"),
    *("arm", "shoulder", "turret", "wrist", "pivot", "hood"),
)
SIDES = (("left", "right"), ("front", "back"), ("front", "rear"), ("top", "bottom"))
NEEDED = ("voltage", "position", "velocity")  # of every motor, for a fit
MOVING = ("position", "velocity")
SHARE = {"voltage": 1 / 2, "position": 1 / 6, "velocity": 1 / 6}  # of the log's points
FEW = 2  # loops that may differ: the first of a test, and one more
SAME = 0.02  # [share] what two ratios of voltages may differ in that are the same
MANY = 6  # no robot has more motors in a log
NEAR = 2e-3  # [share] how well a factor is known
PATIENCE = 0.04  # [s] a callback may keep the loop waiting
LONGEST = 2.0  # [m] no wheel or drum lays so much behind it in one rotation of its motor
LARGE = 1000.0  # [m] from here on a length is written without decimals
APPLIED = (
    "Log the voltage that the motor got: getMotorVoltage(), getAppliedOutput() times the bus "
    "voltage, or in Python getVoltage()."
)
SIZE = re.compile(r"gear|ratio|diameter|radius|circumference", re.IGNORECASE)
GEARS = re.compile(r"gear|ratio|reduction", re.IGNORECASE)
WHEEL = re.compile(r"diameter|radius", re.IGNORECASE)
ONE_TURN = re.compile(r"per_?(turn|rot|rev)|circumference|conversion|factor", re.IGNORECASE)
SLIPS = {  # what a velocity is of the slope of its position, and how that comes about
    60.0: "One is per minute, the other per second",
    2 * math.pi: "One is in radians, the other in rotations",
    360.0: "One is in degrees, the other in rotations",
    180 / math.pi: "One is in degrees, the other in radians",
}
COPIED = "Did you copy a line and forget to change it?"
UNCHANGED = "Pass the voltage to setVoltage() unchanged."
REPORTS = {"position": "rotations", "velocity": "rotations per second"}

Advice = Callable[[float], tuple[str, str]]
Fault = tuple[str, str, str]  # what is seen, the advice, the misconception


def explain_doubt(what: str, text: str) -> str:
    """A message that asks the learner about code whose effect nobody can know."""
    return f"the grader cannot know {what}{f': {text}' if text else ''}"


def quote(line: int) -> str:
    """Where something stands, at the end of a sentence."""
    return f" (line {line})" if line else ""


def list_tests(tests: Iterable[str]) -> str:
    """Tests in words: ``dynamic forward and dynamic reverse``; all four are ``every test``."""
    found = [one.replace("-", " ") for one in dict.fromkeys(tests)]
    return "every test" if len(found) == 4 else " and ".join(found)  # noqa: PLR2004 - there are four


def ask_for_files(unknown: Mapping[str, int], earned: float = 0.0) -> None:
    """Ask for what is in no file here, where what is missing may be in it.

    Args:
        unknown: a name, and the line that uses it.
        earned: points all the same.

    Raises:
        WrongAnswer: there is such a name.
    """
    for name, line in unknown.items():
        raise WrongAnswer(
            f"the grader cannot know what {name.rpartition('.')[2]} does{quote(line)}: it is in no "
            "file here",
            hint="Put its file into the same folder, or its class into this file, and grade again.",
            earned=earned,
        )


# -- before any check ------------------------------------------------------------------------


def check_compiles(errors: Sequence[ParseProblem], *, language: str, earned: float = 0.0) -> None:
    """Raise ``WrongAnswer`` if a compiler, or Python itself, would stop at an error.

    Args:
        errors: what it found.
        language: ``java`` or ``python``.
        earned: points all the same.
    """
    if errors:
        one = errors[0]
        stops = "the code does not compile" if language == "java" else "Python stops with an error"
        more = f" There are {len(errors)} such lines." if len(errors) > 1 else ""
        other = f" of {one.file}" if one.file else ""
        raise WrongAnswer(
            f"line {one.line}{other}: {one.message}",
            hint=f"With this line {stops}, and the robot does not start. Correct it.{more}",
            earned=earned,
        )


def check_stop(facts: RoutineFacts, *places: str, earned: float = 0.0) -> None:
    """Raise ``WrongAnswer`` if the program stopped at one of some places.

    Args:
        facts: the run.
        places: ``start``, ``drive``, ``log``, ``periodic``, ``command``.
        earned: points all the same.
    """
    stop = facts.stop
    if stop is None or stop.where not in places:
        return
    check_compiles(facts.errors, language=facts.language, earned=earned)
    if stop.outcome is Outcome.CANNOT:
        raise NotReachedError(stop.said)
    raise explain_stop(stop, facts.language, earned)


def explain_stop(stop: Stop, language: str, earned: float = 0.0) -> WrongAnswer:
    """The answer to a program that came to an end that nobody wanted."""
    when = {
        "start": "when the robot's program starts",
        "drive": "in the drive callback",
        "log": "in the log callback",
        "periodic": "in periodic() or a trigger",
        "command": "when a test is started",
    }[stop.where]
    if stop.outcome is Outcome.ENDLESS:
        return WrongAnswer(
            f"the program hangs {when}{quote(stop.line)}: {stop.said}",
            hint="A robot's loop has 0.02 s. Whatever waits or repeats has to come back at once.",
            earned=earned,
        )
    if re.search(r"(quasistatic|dynamic)\W.*(takes|missing|argument)", stop.said):
        return WrongAnswer(
            f"the program stops {when}{quote(stop.line)}: {stop.said}",
            hint="SysIdRoutine is the class, and it has no motors: ask the object that you made, "
            "as in self.routine.quasistatic(direction).",
            earned=earned,
        )
    return WrongAnswer(
        f"the program stops {when}{quote(stop.line)}: {stop.said}",
        hint="On the robot it would stop in the same way. Mend that line, and grade again."
        if language == "python" or not stop.said.startswith("java.")
        else "On the robot this exception ends the program. Mend that line, and grade again.",
        earned=earned,
    )


def _check_swapped(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` if the drive callback treats the voltage as a log."""
    stop = facts.stop
    said = [(one.message, one.line) for one in facts.errors]
    said += [(stop.said, stop.line)] if stop is not None else []
    for message, line in said:
        if re.search(r"(Voltage|float'|Measure) (has no|object has no attribute) '?motor", message):
            raise WrongAnswer(
                f"the drive callback gets the voltage, and asks it for a motor{quote(line)}",
                hint="Are the two callbacks swapped? The Mechanism takes first the one that gets "
                "the voltage, then the one that gets the log.",
                misconception="M-ARGORDER",
            )


def check_found(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` unless the subsystem makes a SysIdRoutine and keeps it."""
    if not facts.line:
        check_compiles(facts.errors, language=facts.language)
        check_stop(facts, "start", "command")
        ask_for_files(facts.unknown)
        raise WrongAnswer(
            "no SysIdRoutine is made when the robot starts",
            hint="Make one where the motors are made, and keep it in a field.",
        )
    if not facts.kept:
        raise WrongAnswer(
            f"nothing keeps the SysIdRoutine of line {facts.line}",
            hint="A local variable is gone when its method ends, and no test can be started. Keep "
            "the routine in a field.",
        )


# -- the Config -----------------------------------------------------------------------------


@dataclass(frozen=True)
class ConfigSetting:
    """A number of the Config, as an exercise asks for it.

    Args:
        name: in words: ``step voltage``.
        value: in SI.
        unit: its symbol.
        default: WPILib's own value.
        java, python: how to write it.
    """

    name: str
    value: float
    unit: str
    default: float
    java: str
    python: str

    def check(self, facts: RoutineFacts, got: Setting, *, advice: Advice) -> str | None:
        """Compare the setting with what the program passed.

        Args:
            facts: the run.
            got: the number in question.
            advice: a wrong value -> a sentence about it and the misconception behind it, or empty.

        Returns:
            A note where the number is right by default only.

        Raises:
            WrongAnswer: it is another number, or no such quantity, or cannot be known.
        """
        asked = (
            f"{self.value:g} {self.unit}: "
            f"{self.python if facts.language == 'python' else self.java}"
        )
        if got.problem:
            hint = f"The {self.name} is in {self.unit}. This exercise asks for {asked}."
            misconception = "" if "no null" in got.problem else got.misconception
            if got.problem.startswith("None"):
                hint += " Only Java takes null for its default: RobotPy stops with a TypeError."
                misconception = ""
            others = [facts.ramp.problem, facts.step.problem, facts.timeout.problem]
            swapped = sum(map(bool, others)) > 1
            if swapped:
                hint += " Config takes the ramp first, then the step, then the timeout."
                misconception = "M-ARGORDER"
            raise WrongAnswer(got.problem, hint=hint, misconception=misconception)
        if got.value is None:
            check_compiles(facts.errors, language=facts.language)
            raise WrongAnswer(
                explain_doubt(f"the {self.name}", got.text),
                hint="Write it as a number, or put the file with its constant into the same "
                "folder.",
            )
        right = math.isclose(got.value, self.value, rel_tol=1e-9)
        seen = f"{got.value:g} {self.unit}"
        if got.default:
            seen = f"left to WPILib's default, {seen}"
            if right:
                return f"This is {seen}. Write the number anyway: a default may change."
        if right:
            return None
        said, misconception = advice(got.value)
        if got.value == 0:
            said = "Whole numbers divide to a whole number in Java: 1 / 2 is 0."
        hint = f"{said} This exercise asks for {asked}.".strip()
        raise WrongAnswer(f"{seen}{quote(got.line)}", hint=hint, misconception=misconception)


# -- the drive callback ---------------------------------------------------------------------


def list_driven(facts: RoutineFacts) -> list[DeviceFacts]:
    """The motors that the test has to move.

    While a swerve drive goes straight, a closed loop holds its steering: such a motor gets closed
    loops in every test and no voltage, and others of the subsystem are driven.
    """
    motors = list(facts.motors.values())
    kinds = {
        one.name: {
            sent.kind for test in facts.tests.values() for sent in test.motors[one.name].sent
        }
        for one in motors
    }
    some = [one for one in motors if kinds[one.name] & {"voltage", "duty"}]
    steering = [one for one in motors if kinds[one.name] == {"closed-loop"} and not one.follows]
    return [one for one in motors if one not in steering] if some else motors


def check_driven(facts: RoutineFacts, *, points: float, mirrored: bool) -> str | None:
    """Raise ``WrongAnswer`` unless every motor gets the voltage of every test.

    Args:
        facts: the run.
        points: of the check.
        mirrored: whether a motor may get the other sign, as one that is mounted the other way.

    Returns:
        A note on a motor that gets the other sign and may.
    """
    if not facts.drive:
        check_compiles(facts.errors, language=facts.language)
        raise WrongAnswer(
            "no drive callback",
            hint="It gets the voltage of the test: pass it to setVoltage() of every motor.",
        )
    _check_swapped(facts)
    check_stop(facts, "drive", "command", "periodic", "start")
    motors = list_driven(facts)
    if not facts.tests or not motors:
        check_compiles(facts.errors, language=facts.language)
        check_stop(facts, "log")
        ask_for_files(facts.unknown)
        raise WrongAnswer(
            "the drive callback moves no motor",
            hint="It gets the voltage of the test: pass it to setVoltage() of every motor.",
        )
    wrong = [
        (one, fault)
        for one in motors
        if (fault := _find_drive_fault(one, facts, mirrored=mirrored))
    ]
    if wrong:
        earned = round(points * (1 - len(wrong) / len(motors)), 1)
        check_compiles(facts.errors, language=facts.language, earned=earned)
        (_, (seen, hint, misconception)) = wrong[0]
        raise WrongAnswer(seen, hint=hint, misconception=misconception, earned=earned)
    for name, test in facts.tests.items():
        if test.blocked > PATIENCE:
            raise WrongAnswer(
                f"the program keeps its loop waiting for {test.blocked:.1f} s in "
                f"{name.replace('-', ' ')}",
                hint="While it waits, nothing else of the robot runs, and the test's times are "
                "wrong. Never wait in a callback.",
                earned=round(points / 2, 1),
            )
    return _note_driven(motors, facts)


def _note_driven(motors: Sequence[DeviceFacts], facts: RoutineFacts) -> str | None:
    """What to say of motors that get the right voltage."""
    methods = {
        sent.method
        for one in motors
        for run in _runs(one.name, facts).values()
        for sent in run.sent
    }
    flipped = [one.name for one in motors if _ratio(one, facts) == -1]
    if not flipped and "setControl(VoltageOut)" in methods:
        return "setVoltage() sends a VoltageOut, too. Keep one request object and reuse it."
    if flipped:
        return (
            f"{flipped[0]} gets the other sign. That is right only if it is mounted the other way "
            "round. To invert it where it is made is safer."
        )
    return None


def _runs(name: str, facts: RoutineFacts) -> dict[str, Driven]:
    return {test: run.motors[name] for test, run in facts.tests.items() if name in run.motors}


def _ratio(motor: DeviceFacts, facts: RoutineFacts) -> int | None:
    """1 or -1 if a motor got the test's voltage with that sign in all tests; else None."""
    ratios = {run.ratio for run in _runs(motor.name, facts).values()}
    signs = {round(ratio) for ratio in ratios if ratio is not None and abs(abs(ratio) - 1) < SAME}
    return signs.pop() if len(signs) == 1 and None not in ratios else None


def _find_drive_fault(motor: DeviceFacts, facts: RoutineFacts, *, mirrored: bool) -> Fault | None:
    """What is wrong with what a motor gets in the tests; None if nothing is."""
    runs = _runs(motor.name, facts)
    bad = {test: run for test, run in runs.items() if run.wrong > FEW}
    fault = next(_list_command_faults(motor, runs, bad), None)
    if fault is not None:
        return fault
    cuts = [(test.endswith("forward"), run.cut) for test, run in bad.items() if run.cut is not None]
    if mirrored and len(cuts) == len(bad) > 1 and _are_limits(cuts):
        return None
    ratio = _ratio(motor, facts)
    fault = next(_list_direction_faults(motor, facts, mirrored=mirrored, right=not bad), None)
    if fault is not None or ratio == -1 or not bad or (motor.follows and ratio):
        return fault
    return _describe_voltage(motor.name, bad, runs)


def _find_drive_line(runs: dict[str, Driven]) -> int:
    """The first line of the drive callback that sends a motor something; 0 if none does."""
    every = (sent for run in runs.values() for sent in run.sent)
    return next((one.line for one in every if one.phase == "drive"), 0)


def _list_command_faults(
    motor: DeviceFacts, runs: dict[str, Driven], bad: dict[str, Driven]
) -> Iterator[Fault]:
    """What is wrong with the commands that a motor gets, the worst first."""
    name = motor.name
    unknown = next((run.unknown for run in runs.values() if run.unknown), "")
    sent = [one for run in runs.values() for one in run.sent]
    closed = next(
        (one for one in sent if one.kind in {"closed-loop", "current"} and one.phase == "drive"),
        None,
    )
    if closed is not None:
        yield (
            f"{name} gets {closed.method}{quote(closed.line)}: a closed loop, not the voltage",
            UNCHANGED,
            "M-CLOSEDLOOP",
        )
    if unknown:
        yield (
            explain_doubt(f"what voltage {name} gets", unknown),
            "Call setVoltage() with the voltage of the callback.",
            "",
        )
    if motor.follows == "?":
        yield (
            f"{name} follows a motor that is not there{quote(motor.line)}",
            "Give the follower the ID of its leader.",
            "",
        )
    if runs and all(run.never for run in runs.values()):
        hint = "Drive every motor. The others have to turn one that gets no voltage, and kS and kA "
        yield (
            f"{name} gets no voltage in {list_tests(runs)}{quote(motor.line)}",
            f"{hint}become too large.",
            "",
        )
    others = [one for one in sent if one.phase != "drive" and one.kind != "follow"]
    if others:
        yield _describe_intruder(name, others[-1], bad)
    flipped = [test for test, run in runs.items() if run.flipped]
    if flipped:
        yield (
            f"{name} changes its inversion during {list_tests(flipped)}",
            "Invert a motor once, where it is made.",
            "",
        )


def _list_direction_faults(
    motor: DeviceFacts, facts: RoutineFacts, *, mirrored: bool, right: bool
) -> Iterator[Fault]:
    """What is wrong with the way a motor turns: as a follower, by its sign, by its settings.

    Args:
        motor: the motor.
        facts: the run.
        mirrored: whether it may get the other sign.
        right: whether it gets the voltage of every test.
    """
    runs = _runs(motor.name, facts)
    name, ratio = motor.name, _ratio(motor, facts)
    forward = (ratio or 1) * (-1 if motor.backward else 1)
    if (
        _find_side(name, SIDES[0])
        and _find_other_side(name, motor.follows)
        and _turn_independently(facts, SIDES[0])
    ):
        yield (
            f"{name} follows {motor.follows}{quote(motor.line)}",
            (
                "A follower turns the gears of its leader's side. Give it the ID of the leader "
                "on its own side."
            ),
            "",
        )
    if motor.follows and ratio:
        if motor.mounted and forward < 0:
            yield (
                (
                    f"{name} follows {motor.follows}, and turns its side of the robot "
                    f"backward{quote(motor.line)}"
                ),
                "Choose the other alignment of the follower.",
                "",
            )
        return
    if ratio == -1 and (not mirrored or motor.inverted):
        if motor.inverted and forward > 0:
            hint = (
                "The code inverts this motor as well, and two inversions cancel. Leave one of "
                "them out."
            )
        else:
            hint = (
                "Nothing here says that this motor is mounted the other way round. If it is, "
                "invert it where it is made, and send both sides the same voltage."
            )
        yield f"{name}{quote(_find_drive_line(runs))}: the sign of the voltage is changed", hint, ""
    if motor.backward and right:
        yield (
            f"a positive voltage drives {name}'s side backward, by its settings{quote(motor.line)}",
            (
                "In this task plus is forward on both sides as the file was given. Leave the "
                "inversion as it was."
            ),
            "",
        )


def _describe_intruder(name: str, one: Sent, bad: dict[str, Driven]) -> Fault:
    """Words for a command that other code than the drive callback gives during a test."""
    where = {"log": "the log callback", "periodic": "periodic()"}.get(one.phase, "other code")
    method = one.method.partition("(")[0]
    seen = f"{where} calls {method}() on {name}{quote(one.line)} in every loop of a test"
    if bad:
        _, asked, got = next(iter(bad.values())).at
        seen += f": it gets {got:.3g} V when the test asks for {asked:.3g} V"
    hint = "It runs also during a test, and changes the voltage. Let only the drive callback move "
    return seen, f"{hint}the motors of a test.", ""


def _are_limits(cuts: Sequence[tuple[bool, float]]) -> bool:
    """Whether a motor was cut off at the same places, as by the ends of an arm's travel."""
    for way in (True, False):
        found = [position for forward, position in cuts if forward is way]
        if found and max(found) - min(found) > 0.1 * max(1.0, abs(found[0])):  # of a rotation
            return False
    return True


def _describe_voltage(name: str, bad: dict[str, Driven], runs: dict[str, Driven]) -> Fault:
    """Words for a motor that got another voltage than the test asked for."""
    test, run = next(iter(bad.items()))
    line = _find_drive_line(runs)
    every = [sent for one in runs.values() for sent in one.sent]
    kinds = {one.kind for one in every if one.phase == "drive"}
    time, asked, got = run.at
    seen = (
        f"in {test.replace('-', ' ')}, after {time:.1f} s, {name} gets {got:.3g} V when the test "
        f"asks for {asked:.3g} V{quote(line)}"
    )
    if run.late:
        return (
            f"{seen}: each voltage comes a loop late",
            "Fill the request first, then send it.",
            "",
        )
    if all(one.never for one in bad.values()) and len(bad) < len(runs):
        return (
            f"{name} gets no voltage in {list_tests(bad)}{quote(line)}",
            f"Every test has to move it, forward and reverse. {UNCHANGED}",
            "",
        )
    ratios = [one.ratio for one in runs.values()]
    same = all(
        r is not None and ratios[0] is not None and abs(r - ratios[0]) < SAME for r in ratios
    )
    share = ratios[0] if same else None
    for nominal in (12.0, 12.5, 13.0, 10.0):
        if share and abs(abs(share) * nominal - 1.0) < SAME and kinds == {"voltage"}:
            return f"{seen}: a share of {nominal:g} V, sent as volts", UNCHANGED, "M-DUTY"
    if kinds == {"duty"} and not any(one.method.startswith("setVoltage") for one in run.sent):
        return f"{seen}: a duty cycle, a share of the battery", UNCHANGED, "M-DUTY"
    steady = {round(one.at[2], 2) for one in bad.values()}
    if (
        len(bad) > 1
        and len(steady) == 1
        and all(one.ratio is None or test.startswith("dyn") for test, one in bad.items())
    ):
        return (
            f"{seen}: it always gets {got:.3g} V",
            (
                "That does not depend on the test. Send the voltage that the callback gets. The "
                "routine ends a test by sending 0 V, so this motor would drive on after the button "
                "is released."
            ),
            "",
        )
    return seen, f"Your code changes the voltage. {UNCHANGED}", ""


def check_open_loop(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` if the drive callback uses a closed loop or a duty cycle."""
    if not facts.drive or not any(run.motors for run in facts.tests.values()):
        raise NotReachedError("checked after the drive callback moves a motor")
    sent = [
        one
        for motor in list_driven(facts)
        for run in _runs(motor.name, facts).values()
        for one in run.sent
        if one.phase == "drive"
    ]
    if not sent:
        check_compiles(facts.errors, language=facts.language)
        raise NotReachedError("checked after the drive callback moves a motor")
    for one in sent:
        if one.kind == "duty" and not one.method.startswith("setVoltage"):
            hint = "A test commands volts, so send volts: setVoltage(voltage), not divided."
            raise WrongAnswer(f"{one.method}(){quote(one.line)}", hint=hint, misconception="M-DUTY")
        if one.kind in {"closed-loop", "current"}:
            hint = "Send the voltage unchanged, and use no controller in the test."
            raise WrongAnswer(
                f"{one.method}{quote(one.line)}", hint=hint, misconception="M-CLOSEDLOOP"
            )


# -- the log callback -----------------------------------------------------------------------


def list_signals(facts: RoutineFacts) -> dict[str, dict[str, list[Signal]]]:
    """Name in the log -> signal -> what it was in each test."""
    found: dict[str, dict[str, list[Signal]]] = {}
    for test in facts.tests.values():
        for name, signals in test.signals.items():
            for signal, one in signals.items():
                found.setdefault(name, {}).setdefault(signal, []).append(one)
    return found


def check_logged(facts: RoutineFacts, *, points: float, demanded: int) -> None:
    """Raise ``WrongAnswer`` unless all signals that a fit needs of every motor are recorded.

    Args:
        facts: the run.
        points: of the check: half of it is the voltage's.
        demanded: how many motors the task itself asks for; 0 if it does not say.
    """
    if facts.log is False or (
        facts.stop and "'NoneType' object is not callable" in facts.stop.said
    ):
        python = facts.language == "python"
        raise WrongAnswer(
            "None in place of the log callback: RobotPy stops with a TypeError in the first loop"
            if python
            else "null instead of the log callback: then WPILib records nothing",
            hint="Where a vendor's logger records the motors, write `lambda log: None`. Here, "
            "write a callback that fills the log."
            if python
            else "null is for robots whose motors a vendor's logger or AdvantageKit records. Here, "
            "write a callback that fills the log.",
        )
    _check_swapped(facts)
    check_stop(facts, "drive", "log", "command", "periodic", "start")
    there = list_signals(facts)
    if not there:
        check_compiles(facts.errors, language=facts.language)
        ask_for_files(facts.unknown)
        raise WrongAnswer(
            "the log callback records nothing",
            hint='It gets a log: log.motor("left"), then voltage, position and velocity.',
        )
    faults = list(_find_log_faults(facts, there))
    if faults:
        lost = {signal: SHARE.get(signal.rpartition(" ")[2], 1 / 6) for signal, _ in faults}
        earned = max(round(points * (1 - sum(lost.values())), 1), 0.0)
        check_compiles(facts.errors, language=facts.language, earned=earned)
        seen, hint, misconception = faults[0][1]
        raise WrongAnswer(seen, hint=hint, misconception=misconception, earned=earned)
    _check_all_logged(facts, there, demanded=demanded, points=points)


def _find_log_faults(
    facts: RoutineFacts, there: dict[str, dict[str, list[Signal]]]
) -> Iterator[tuple[str, Fault]]:
    """Each fault with the signal that it is about."""
    for name, signals in there.items():
        yield from _find_name_faults(name, signals, facts)
        for signal in NEEDED:
            many = signals.get(signal, [])
            if len({one.scale > 0 for one in many if one.scale}) > 1:  # forward and reverse differ
                many = [replace(one, absolute=True) for one in many]
            for one in many:
                fault = next(_list_signal_faults(name, signal, one), None)
                if fault:
                    yield f"{name} {signal}", fault
                    break
    rows = [sum(s.loops for s in signals.get("voltage", [])) for signals in there.values()]
    loops = sum(test.logs for test in facts.tests.values())
    few = [
        name
        for name, count in zip(there, rows, strict=True)
        if count and count < loops - FEW * len(facts.tests)
    ]
    if few and (len(there) > MANY or len(few) == len(there)):
        name = few[0]
        count = rows[list(there).index(name)]
        said = (
            f"{len(there)} names are in the log"
            if len(there) > MANY
            else f"{name} is logged in {count} of {loops} loops"
        )
        yield (
            f"{name} voltage",
            (said, "Record every motor in every loop, always under the same name.", ""),
        )
    yield from _find_shared_motors(there)


def _find_name_faults(
    name: str, signals: dict[str, list[Signal]], facts: RoutineFacts
) -> Iterator[tuple[str, Fault]]:
    lacking = [signal for signal in NEEDED if signal not in signals]
    if lacking:
        hint = "A fit needs all three of every motor: voltage, position and velocity."
        if lacking == ["position"]:
            hint = (
                "SysId's window refuses a motor without a position. (For a drivetrain, our own fit "
                "gets by with voltage and velocity; an arm's or elevator's needs the position.)"
            )
        for signal in lacking:
            yield f"{name} {signal}", (f"no {' and no '.join(lacking)} of {name}", hint, "")
    loops = {
        signal: sum(one.loops for one in signals[signal]) for signal in NEEDED if signal in signals
    }
    logs = sum(test.logs for test in facts.tests.values())
    least = min(loops, key=lambda key: loops[key], default="")
    if (
        least
        and loops[least] < logs - FEW * len(facts.tests)
        and loops[least] < max(loops.values())
    ):
        yield (
            f"{name} {least}",
            (
                (
                    f"{name}'s {least} is logged in {loops[least]} of {logs} "
                    f"loops{quote(signals[least][0].line)}"
                ),
                "Record every signal each time the callback is called, without a condition.",
                "",
            ),
        )
    elif least and loops[least] < logs - FEW * len(facts.tests):
        silent = [
            t
            for t, run in facts.tests.items()
            if run.signals.get(name, {}).get(least, Signal()).loops < run.logs - FEW
        ]
        if silent and len(facts.tests) > 1:
            yield (
                f"{name} {least}",
                (
                    (
                        f"{name} is not logged in all loops of "
                        f"{list_tests(silent)}{quote(signals[least][0].line)}"
                    ),
                    "Record every signal each time the callback is called, without a condition.",
                    "",
                ),
            )


def _list_signal_faults(name: str, signal: str, one: Signal) -> Iterator[Fault]:
    """What is wrong with a signal of the log, the worst first."""
    at = quote(one.line)
    if one.twice:
        yield (
            f"{name}'s {signal} is written more than once in a loop{at}",
            "Only one motor may log under a name. Is the name of the second one copied, too?",
            "",
        )
    if one.idle and not one.unknown:
        return
    if one.unknown:
        yield (
            explain_doubt(f"where the {signal} of {name} comes from", f"{one.unknown}{at}"),
            "Ask the motor itself for it, in the log callback, and hand in every file it needs.",
            "",
        )
    if signal == "voltage":
        yield from _list_voltage_faults(name, one, at)
        return
    part, _, motor = one.follows.partition(" ")
    if one.still:
        yield (
            f"{name}'s {signal} stays {one.values[0]:.3g} while the motor turns{at}",
            (
                "Something resets it in every loop, or it was read only once. Read the sensor in "
                "the callback (a status signal that is kept needs refresh()), and reset nothing in "
                "a test."
            ),
            "",
        )
    if not part:
        hint = (
            "Log what the sensor says now, converted by one factor. Do not filter, round or "
            "average it."
        )
        yield f"{name}'s {signal} follows no motor's {signal}{at}", hint, ""
    if part != signal:
        yield (
            f"the {signal} of {name} is the {part} of {motor}{at}",
            f"Log the {signal} there: each value has its own method.",
            "",
        )
    if one.absolute:
        yield (
            f"the {signal} of {name} loses its sign{at}",
            "Half of the tests run backward. Log the number with its sign.",
            "",
        )
    if signal == "velocity" and one.scale and abs(one.offset) > NEAR * 10 * abs(one.scale):
        yield (
            f"{name}'s velocity is {one.offset:.3g} too large all the time{at}",
            "An offset in the velocity makes kS wrong. Log the sensor's number.",
            "",
        )


def _list_voltage_faults(name: str, one: Signal, at: str) -> Iterator[Fault]:
    """What is wrong with a logged voltage, the worst first."""
    if one.asked:
        yield (
            (
                f"{name}'s voltage is the commanded voltage{at}: it stays the same when the "
                "motor gets less"
            ),
            APPLIED,
            "M-CMDVOLT",
        )
    if one.battery and not one.follows:
        yield (
            f"{name}'s voltage is the voltage of the battery{at}",
            f"The motor gets only a part of it. {APPLIED}",
            "",
        )
    motor = one.follows.partition(" ")[2]
    if one.absolute:
        yield (
            f"the voltage of {name} loses its sign{at}",
            "Half of the tests run backward. Log the number with its sign.",
            "",
        )
    if not one.follows:
        yield f"{name}'s voltage follows no motor's voltage{at}", APPLIED, ""
    if one.scale is not None and abs(one.scale - 1.0) > 0.01:  # noqa: PLR2004 - PWM's steps
        yield f"{name}'s voltage is {one.scale:.3g} times that of {motor}{at}", APPLIED, ""


def _find_shared_motors(there: dict[str, dict[str, list[Signal]]]) -> Iterator[tuple[str, Fault]]:
    """Names whose signals belong to different motors, or to the motor of another name."""
    owners = {name: _find_owners(name, signals) for name, signals in there.items()}
    lines = {
        name: {s: one[0].line for s, one in signals.items()} for name, signals in there.items()
    }
    for name, mine in owners.items():
        for signal, motor in mine.items():
            at = quote(lines[name][signal])
            wrong = _find_other_side(name, motor)
            others = [
                other
                for other, theirs in owners.items()
                if other != name and theirs.get(signal) == motor
            ]
            if wrong and len(set(mine.values())) == 1 and len(mine) == len(NEEDED):
                right = [
                    other
                    for other, theirs in owners.items()
                    if other != name and set(theirs.values()) == {motor}
                ]
                if not right:
                    yield (
                        f"{name} {signal}",
                        (
                            f"everything that is logged under the name {name} is of {motor}{at}",
                            f"The values are right for {motor}, so the name is wrong. {COPIED}",
                            "",
                        ),
                    )
                    break
            if wrong:
                yield (
                    f"{name} {signal}",
                    (
                        f"{name} gets the {signal} of {motor}{at}",
                        f"{COPIED} Under the name {name}, log the values of the {wrong} motor.",
                        "",
                    ),
                )
            elif others and set(mine.values()) != {motor}:
                yield (
                    f"{name} {signal}",
                    (
                        f"{name} gets the {signal} of {motor}{at}, and so does {others[0]}",
                        f"{COPIED} Log for {name} the values of its own motor and its own encoder.",
                        "",
                    ),
                )
        yield from _find_mixed_motors(name, mine, lines[name])
    yield from _find_same_motors(owners, lines)


def _find_mixed_motors(
    name: str, mine: dict[str, str], lines: dict[str, int]
) -> Iterator[tuple[str, Fault]]:
    """One name whose signals belong to different motors, where no side tells which is meant."""
    if len(set(mine.values())) > 1 and not any(
        _find_other_side(name, motor) for motor in mine.values()
    ):
        (first, one), *rest = mine.items()
        signal, motor = next(pair for pair in rest if pair[1] != one)
        yield (
            f"{name} {signal}",
            (
                (
                    f"the {signal} of {name} comes from {motor}, its {first} from "
                    f"{one}{quote(lines[signal])}"
                ),
                "All three signals of a motor must come from the same motor.",
                "",
            ),
        )


def _find_same_motors(
    owners: dict[str, dict[str, str]], lines: dict[str, dict[str, int]]
) -> Iterator[tuple[str, Fault]]:
    """Two names that log the same motor."""
    whole = [
        (name, next(iter(mine.values())))
        for name, mine in owners.items()
        if len(set(mine.values())) == 1
    ]
    for place, (name, motor) in enumerate(whole):
        twin = next((other for other, theirs in whole[:place] if theirs == motor), None)
        if twin is not None and not _find_other_side(name, motor):
            yield (
                f"{name} voltage",
                (
                    (
                        f"{twin} and {name} are the same motor: "
                        f"{motor}{quote(lines[name].get('voltage', 0))}"
                    ),
                    f"{COPIED} Log for {name} the values of its own motor and its own encoder.",
                    "",
                ),
            )


def _find_owners(name: str, signals: dict[str, list[Signal]]) -> dict[str, str]:
    """Signal -> its motor; where it could be of several, the one that agrees with the rest."""
    could = {
        signal: set.intersection(
            *[set(one.owners) for one in many if one.owners or one.follows] or [set()]
        )
        for signal, many in signals.items()
        if signal in NEEDED
    }
    sure = [next(iter(one)) for one in could.values() if len(one) == 1]
    named = [one for motors in could.values() for one in motors if not _find_other_side(name, one)]
    best = [*sure, *named]
    return {
        signal: next((one for one in best if one in motors), min(motors))
        for signal, motors in could.items()
        if motors
    }


def _split_words(name: str) -> list[str]:
    """``m_leftMotor`` -> ``["m", "left", "motor"]``."""
    return [word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)]


def _find_side(name: str, pair: tuple[str, str]) -> str:
    """The side that a name tells, of a pair; empty if it tells none or both."""
    words = _split_words(name)
    found = [side for side in pair if side in words]
    return found[0] if len(found) == 1 else ""


def _find_other_side(name: str, motor: str) -> str:
    """The side that a name tells where the motor's name tells another; else empty."""
    for pair in SIDES:
        named, asked = _find_side(name, pair), _find_side(motor, pair)
        if named and asked and named != asked:
            return named
    return ""


def _check_all_logged(
    facts: RoutineFacts, there: dict[str, dict[str, list[Signal]]], *, demanded: int, points: float
) -> None:
    """Raise ``WrongAnswer`` unless every driven motor, or each side of a drivetrain, is logged."""
    driven = [one for one in list_driven(facts) if not one.follows]
    logged = {
        one[0].follows.partition(" ")[2] for signals in there.values() for one in signals.values()
    }
    for pair in SIDES:
        sides = {_find_side(one.name, pair) for one in driven} - {""}
        told = {_find_side(text, pair) for text in (*there, *logged)} - {""}
        if len(sides) > 1 and told & sides and sides - told and _turn_independently(facts, pair):
            missing = min(sides - told)
            _raise_missing(f"no {missing} motor in the log", points / 2)
    if len(there) < min(demanded, len(driven)):
        _raise_missing(
            f"{len(there)} of {len(driven)} motors in the log", points * len(there) / len(driven)
        )


def _raise_missing(seen: str, earned: float) -> None:
    raise WrongAnswer(
        seen,
        hint="The Mechanism drives two sides, and each has its own friction. Log every motor, each "
        "under its own name.",
        earned=round(earned, 1),
    )


def _turn_independently(facts: RoutineFacts, pair: tuple[str, str]) -> bool:
    """Whether the motors of a class turn on their own, by its name, and not one shaft together."""
    own = (*DRIVES, *SHOOTERS) if pair == ("top", "bottom") else DRIVES
    words = _split_words(facts.name)
    return any(word.startswith(own) for word in words) or not any(
        word.startswith((*LINEAR, *ANGULAR)) for word in words
    )


# -- units ----------------------------------------------------------------------------------


def find_motion_family(name: str) -> str:
    """The motion of a mechanism of this name, ``linear`` or ``angular``; empty if unknown."""
    words = _split_words(name)
    linear = any(word.startswith(LINEAR) for word in words)
    angular = any(word.startswith(ANGULAR) for word in words)
    if linear == angular:
        return ""
    return "linear" if linear else "angular"


def check_units(facts: RoutineFacts, *, mechanism: str, scales: dict[str, float]) -> None:
    """Raise ``WrongAnswer`` unless positions and velocities fit each other and the mechanism.

    Args:
        facts: the run.
        mechanism: a name that may tell how it moves.
        scales: what the task says is one rotation of a device's motor [m], by the device's type.
    """
    there = list_signals(facts)
    moving = {
        (name, signal): next((one for one in signals[signal] if one.scale), signals[signal][0])
        for name, signals in there.items()
        for signal in MOVING
        if signal in signals
    }
    if not moving:
        check_compiles(facts.errors, language=facts.language)
        raise NotReachedError("checked after you record position and velocity")
    seen = ", ".join(
        f"{name}'s {signal} in {one.unit or 'an unknown unit'}{quote(one.line)}"
        for (name, signal), one in moving.items()
    )
    families = {one.family for one in moving.values() if one.family}
    wanted = find_motion_family(mechanism)
    if len(families) > 1:
        _raise_unit(
            seen, "Some of these are lengths and others are angles. Choose one kind for all."
        )
    if wanted and families and families != {wanted}:
        unit = "Meters" if wanted == "linear" else "Rotations or Radians"
        _raise_unit(seen, f"By its name, {mechanism} moves in {unit}. Log it in {unit}.")
    _check_circumference(facts)
    devices = {one.name: one for one in facts.devices}
    for (name, signal), one in moving.items():
        _check_scale(name, signal, one, devices, scales)
    _check_gearing([devices.get(one.follows.partition(" ")[2]) for one in moving.values()])
    for name in there:
        _check_rate(name, moving.get((name, "position")), moving.get((name, "velocity")))
    for signal in MOVING:
        _check_alike([(name, one) for (name, kind), one in moving.items() if kind == signal])
    _check_signs(there)


def _check_circumference(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` unless one turn is π diameters of the wheel, or 2π radii."""
    gears = [value for name, value in facts.constants.items() if GEARS.search(name) and value]
    wheels = {name: size for name, size in facts.constants.items() if WHEEL.search(name)}
    for name, size in facts.constants.items():
        if SIZE.search(name) and not size > 0.0:
            hint = "No gear ratio and no wheel is zero or less. Write what is built in."
            _raise_unit(f"{name} is {size:g}", hint)
    for (name, way), (wheel, size) in itertools.product(facts.constants.items(), wheels.items()):
        if not ONE_TURN.search(name) or name == wheel:
            continue
        turns = [abs(way) / size * by for by in (1.0, *gears, *(1.0 / one for one in gears))]
        right = 2.0 * math.pi if "radi" in wheel.lower() else math.pi
        slips = (1.0, 2.0, math.pi / 2.0, math.pi, 2.0 * math.pi, 4.0 * math.pi)
        close = [slip for slip in (right, *slips) if any(_close(one, slip) for one in turns if one)]
        if close and right not in close:
            formula = f"{'2π' if right > math.pi else 'π'} times {wheel}"
            _raise_unit(
                f"{name} is {way:.4g}, and {wheel} {size:.4g}",
                f"In one turn a wheel rolls its circumference, {formula}; divide it by the gear "
                "ratio.",
            )


def _raise_unit(seen: str, hint: str) -> None:
    raise WrongAnswer(seen, hint=hint, misconception="M-UNITS")


def _check_scale(
    name: str, signal: str, one: Signal, devices: dict[str, DeviceFacts], scales: dict[str, float]
) -> None:
    """Whether a logged number is in the unit with which it is logged."""
    device = devices.get(one.follows.partition(" ")[2])
    if device is None or not one.scale or not one.follows.startswith(signal):
        return
    sensor = next((d for d in devices.values() if d.turned_by == device.name), None)
    scale, gearing = abs(one.scale), device.gearing
    told = f"{name}'s {signal}{quote(one.line)}: "
    reports = REPORTS[signal]
    unit = one.unit or ("meters" if one.family == "linear" else "an angle")
    reported = scale * gearing  # SI for one rotation as the device reports it
    plain = "The unit's name around a number converts nothing. "
    wanted = scales.get(device.type, scales.get(sensor.type if sensor else "", 0.0))
    if one.family == "linear":
        for factor, what in ((1.0, reports), (60.0, "rotations per minute")):
            if _close(reported, factor) and (factor == 1.0 or signal == "velocity") and not sensor:
                _raise_unit(
                    f"{told}{device.name} reports {what}, and the log says {unit}",
                    f"{plain}Multiply by the meters of one rotation: the wheel's circumference "
                    "over the gear ratio.",
                )
        if scale > LONGEST and (not sensor or wanted):
            length = f"{scale:.3g}" if scale < LARGE else f"{scale:.0f}"
            _raise_unit(
                f"{told}one rotation of {device.name} counts as {length} m",
                f"One rotation would be {length} m. Multiply by the meters of one rotation, and by "
                "nothing else; do not divide by them.",
            )
        if wanted and not _close(scale, wanted):
            _raise_unit(
                f"{told}one rotation counts as {scale:.4g} m, and by the task's own number it is "
                f"{wanted:.4g} m",
                "Multiply by the task's number exactly once, and apply no other ratio.",
            )
    elif one.family == "angular" and not sensor:
        rotations = reported / (2 * math.pi)
        for factor, what in (
            (1 / (2 * math.pi), f"{reports}, and the log says {unit}"),
            (1 / 360, f"{reports}, and the log says {unit}"),
            (60.0, "rotations per minute, and the log takes them for rotations per second"),
            (1 / 60, "rotations per second, and the log takes them for rotations per minute"),
        ):
            if _close(rotations, factor) and (
                (abs(factor - 1) < 1 and factor != 1 / 60) or signal == "velocity"
            ):
                _raise_unit(
                    f"{told}{device.name} reports {what}",
                    f"{plain}Name the unit that the number is in, and a measure converts itself.",
                )


def _close(one: float, other: float) -> bool:
    return abs(one / other - 1.0) < NEAR


def _check_gearing(logged: Sequence[DeviceFacts | None]) -> None:
    """Whether all logged motors report rotations of the mechanism, or none does."""
    motors = [one for one in logged if one is not None]
    bare = [one for one in motors if one.gearing == 1.0]
    geared = (
        [one for one in motors if one.gearing != 1.0 and one.type == bare[0].type] if bare else []
    )
    if geared:
        _raise_unit(
            f"{bare[0].name} gets no configuration, so it reports rotations of the motor; "
            f"{geared[0].name} reports those of the mechanism",
            "Apply the configuration with the gear ratio to every motor.",
        )


def _check_rate(name: str, position: Signal | None, velocity: Signal | None) -> None:
    """Whether the velocity of a motor is the slope of its position."""
    if position is None or velocity is None or not position.scale or not velocity.scale:
        return
    if not velocity.follows.startswith("velocity") or not position.follows.startswith("position"):
        return
    ratio = velocity.scale / position.scale
    if any(_close(abs(ratio), one) for one in (1.0, GEARING, 1 / GEARING)) and ratio > 0:
        return  # an absolute sensor turns slower than the motor, by gears that nobody told
    seen = (
        f"the velocity of {name} is {ratio:.4g} times the slope of its "
        f"position{quote(velocity.line)}"
    )
    if _close(ratio, -1.0):
        raise WrongAnswer(
            seen, hint="One of the two has the wrong sign. Log both with the same sign."
        )
    slips = {**SLIPS, **{1 / factor: said for factor, said in SLIPS.items()}}
    slip = next(
        (said for factor, said in slips.items() if _close(abs(ratio), factor)),
        "They are converted differently",
    )
    _raise_unit(
        seen, f"{slip}. Choose one unit for the position, and the same per second for the velocity."
    )


def _check_alike(signals: Sequence[tuple[str, Signal]]) -> None:
    """Whether both sides of a drivetrain count alike."""
    sided = [(name, one) for name, one in signals if _find_side(name, SIDES[0]) and one.scale]
    for (name, one), (other, second) in pairwise(sided):
        ratio = abs((second.scale or 1.0) / (one.scale or 1.0))
        if not _close(ratio, 1.0) and one.family == second.family:
            _raise_unit(
                f"a rotation of {other} counts {ratio:.4g} times what one of {name} "
                f"counts{quote(second.line)}",
                "Both sides have the same wheels and gears. Convert both in the same way.",
            )


def _check_signs(there: dict[str, dict[str, list[Signal]]]) -> None:
    """Raise ``WrongAnswer`` unless the signals of each motor agree in their sign."""
    for name, signals in there.items():
        signs = {
            signal: math.copysign(1.0, one.scale)
            for signal in NEEDED
            for one in signals.get(signal, ())[:1]
            if one.scale and one.follows.startswith(signal)
        }
        if len(set(signs.values())) > 1:
            odd = min(signs, key=lambda key: list(signs.values()).count(signs[key]))
            raise WrongAnswer(
                f"the {odd} of {name} has a sign of its own{quote(signals[odd][0].line)}",
                hint="A positive voltage must give a positive velocity and a growing position. Log "
                "all three with the same sign.",
            )


# -- the rest -------------------------------------------------------------------------------


def check_assembled(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` unless the parts of the routine are in their places."""
    this = "this" if facts.language == "java" else "self"
    if facts.swapped:
        raise WrongAnswer(
            f"the SysIdRoutine in line {facts.line} gets its arguments in another order",
            hint="First the Config, then the Mechanism.",
            misconception="M-ARGORDER",
        )
    if not facts.is_subsystem and facts.requires != "other":
        raise WrongAnswer(
            f"{facts.name} is not a subsystem",
            hint="Let it extend SubsystemBase (Python: Subsystem).",
        )
    if facts.requires == "none":
        raise WrongAnswer(
            f"no {this} among the Mechanism's arguments",
            hint=f"Pass {this} after the two callbacks. Then no other command can move the motors "
            "during a test. Without a subsystem the program stops as it starts.",
        )
    if facts.requires == "other" and facts.is_subsystem:
        raise WrongAnswer(
            f"the tests require another subsystem than {facts.name}{quote(facts.line)}",
            hint=f"Pass {this} after the two callbacks. Then no other command can move the motors "
            "during a test.",
        )
    check_devices(facts)
    check_compiles(facts.errors, language=facts.language)
    check_stop(facts, "start", "periodic", "command", "drive", "log")


def check_devices(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` if two devices share a port or CAN ID, or one has an impossible one."""
    seen: dict[str, DeviceFacts] = {}
    for one in facts.devices:
        if one.number is not None and one.number < 0:
            raise WrongAnswer(
                f"{one.name} is made with {one.number:g}{quote(one.line)}",
                hint="That cannot be a port or a CAN ID. Check the wiring.",
            )
        other = seen.setdefault(
            f"{one.type} {one.port}" if one.port.startswith("CAN") else one.port, one
        )
        if one.port and other is not one:
            raise WrongAnswer(
                f"{other.name} and {one.name} are made with the same number{quote(one.line)}",
                hint="Two devices cannot share a port or a CAN ID. Did you copy a line and forget "
                "to change it?",
            )


__all__ = ["ConfigSetting", "TestRun"]
