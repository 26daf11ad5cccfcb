"""What is right and wrong about a SysIdRoutine, judged by what it did on the bench.

Every function looks at facts and raises WrongAnswer where they show a fault; where the facts depend
on something that nobody knows, it asks. What the robot did comes first, then the line that did it.
"""

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from grader.check import NotReachedError, WrongAnswer
from grader.robotcode.bench.facts import (
    DeviceFacts,
    Driven,
    Outcome,
    RoutineFacts,
    Sent,
    Setting,
    Stop,
    TestRun,
)
from grader.robotcode.problems import ParseProblem

DRIVES = ("drive", "chassis", "swerve", "tank")
LINEAR = (*DRIVES, "elevator", "lift", "climb", "telescop", "slide")
SHOOTERS = ("shooter", "flywheel")  # top and bottom turn on their own; left and right are one shaft
ANGULAR = (
    *(*SHOOTERS, "roller", "intake", "outtake"),
    *("arm", "shoulder", "turret", "wrist", "pivot", "hood"),
)
SIDES = (("left", "right"), ("front", "back"), ("front", "rear"), ("top", "bottom"))
FEW = 2  # loops that may differ: the first of a test, and one more
SAME = 0.02  # [share] what two ratios of voltages may differ in that are the same
A_LOOP = 0.5  # [rot] that a motor may turn in a loop, before a limit stops it
PATIENCE = 0.04  # [s] a callback may keep the loop waiting
UNCHANGED = "Pass the voltage to setVoltage() unchanged."

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


def check_swapped(facts: RoutineFacts) -> None:
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
    check_swapped(facts)
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
    """1 or -1 if a motor got the test's voltage with that sign in all tests; else None.

    A test whose voltage nobody knows, as with an unknown ramp, does not count.
    """
    ratios = {run.ratio for run in _runs(motor.name, facts).values() if run.loops}
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
    if mirrored and cuts and len(cuts) == len(bad) and _are_limits(cuts):
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
        find_side(name, SIDES[0])
        and find_other_side(name, motor.follows)
        and turn_independently(facts, SIDES[0])
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
        if found and max(found) - min(found) > max(A_LOOP, 0.1 * abs(found[0])):
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


def split_words(name: str) -> list[str]:
    """``m_leftMotor`` -> ``["m", "left", "motor"]``."""
    return [word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)]


def find_side(name: str, pair: tuple[str, str]) -> str:
    """The side that a name tells, of a pair; empty if it tells none or both."""
    words = split_words(name)
    found = [side for side in pair if side in words]
    return found[0] if len(found) == 1 else ""


def find_other_side(name: str, motor: str) -> str:
    """The side that a name tells where the motor's name tells another; else empty."""
    for pair in SIDES:
        named, asked = find_side(name, pair), find_side(motor, pair)
        if named and asked and named != asked:
            return named
    return ""


def turn_independently(facts: RoutineFacts, pair: tuple[str, str]) -> bool:
    """Whether the motors of a class turn on their own, by its name, and not one shaft together."""
    own = (*DRIVES, *SHOOTERS) if pair == ("top", "bottom") else DRIVES
    words = split_words(facts.name)
    return any(word.startswith(own) for word in words) or not any(
        word.startswith((*LINEAR, *ANGULAR)) for word in words
    )


# -- units ----------------------------------------------------------------------------------


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
