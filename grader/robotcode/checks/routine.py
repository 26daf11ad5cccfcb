"""Checks of a SysIdRoutine: its Config, the voltages that its motors get, and its parts."""

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from grader.check import NotReachedError, WrongAnswer
from grader.robotcode.bench.facts import DeviceFacts, Driven, RoutineFacts, Sent, Setting
from grader.robotcode.checks.causes import (
    ask_for_files,
    check_compiles,
    check_stop,
    explain_doubt,
    list_tests,
    quote,
)
from grader.robotcode.checks.motor_names import (
    SIDES,
    find_other_side,
    find_side,
    turn_independently,
)

FEW = 2  # loops that may differ: the first of a test, and one more
SAME = 0.02  # [share] what two ratios of voltages may differ in that are the same
A_LOOP = 0.5  # [rot] that a motor may turn in a loop, before a limit stops it
PATIENCE = 0.04  # [s] a callback may keep the loop waiting
NOMINAL = (12.0, 12.5, 13.0, 10.0)  # [V] by which programs divide a voltage to get a duty cycle
UNCHANGED = "Pass the voltage to setVoltage() unchanged."
GETS_VOLTAGE = "It gets the voltage of the test: pass it to setVoltage() of every motor."
OWNER = "Pass {} after the two callbacks. Then no other command can move the motors during a test."

Advice = Callable[[float], tuple[str, str]]


def check_swapped(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` if the drive callback treats the voltage as a log."""
    said = [(one.message, one.line) for one in facts.errors]
    said += [(facts.stop.said, facts.stop.line)] if facts.stop is not None else []
    for message, line in said:
        if re.search(r"(Voltage|float'|Measure) (has no|object has no attribute) '?motor", message):
            raise WrongAnswer(
                f"the drive callback gets the voltage, and asks it for a motor{quote(line)}",
                hint="Are the two callbacks swapped? The Mechanism takes first the one that gets "
                "the voltage, then the one that gets the log.",
                misconception="M-ARGORDER",
            )


def check_routine_found(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` unless the subsystem makes a SysIdRoutine and keeps it."""
    if not facts.line:
        check_compiles(facts)
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
        way = self.python if facts.language == "python" else self.java
        asks = f"This exercise asks for {self.value:g} {self.unit}: {way}."
        if got.problem:
            hint = f"The {self.name} is in {self.unit}. {asks}"
            misconception = "" if "no null" in got.problem else got.misconception
            if got.problem.startswith("None"):
                hint += " Only Java takes null for its default: RobotPy stops with a TypeError."
                misconception = ""
            if sum(bool(one.problem) for one in (facts.ramp, facts.step, facts.timeout)) > 1:
                hint += " Config takes the ramp first, then the step, then the timeout."
                misconception = "M-ARGORDER"
            raise WrongAnswer(got.problem, hint=hint, misconception=misconception)
        if got.value is None:
            check_compiles(facts)
            raise WrongAnswer(
                explain_doubt(f"the {self.name}", got.text),
                hint="Write it as a number, or put the file with its constant into the same "
                "folder.",
            )
        seen = f"{got.value:g} {self.unit}"
        if got.default:
            seen = f"left to WPILib's default, {seen}"
        if math.isclose(got.value, self.value, rel_tol=1e-9):
            note = f"This is {seen}. Write the number anyway: a default may change."
            return note if got.default else None
        said, misconception = advice(got.value)
        if got.value == 0:
            said = "Whole numbers divide to a whole number in Java: 1 / 2 is 0."
        hint = f"{said} {asks}".strip()
        raise WrongAnswer(f"{seen}{quote(got.line)}", hint=hint, misconception=misconception)


def list_driven(facts: RoutineFacts) -> list[DeviceFacts]:
    """The motors that the test has to move.

    While a swerve drive goes straight, a closed loop holds its steering: such a motor gets closed
    loops in every test and no voltage, and others of the subsystem are driven.
    """
    motors = list(facts.motors.values())
    kinds = {one.name: {sent.kind for sent in _list_sent(one, facts)} for one in motors}
    if not any(kinds[one.name] & {"voltage", "duty"} for one in motors):
        return motors
    return [one for one in motors if one.follows or kinds[one.name] != {"closed-loop"}]


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
        check_compiles(facts)
        raise WrongAnswer("no drive callback", hint=GETS_VOLTAGE)
    check_swapped(facts)
    check_stop(facts, "drive", "command", "periodic", "start")
    motors = list_driven(facts)
    if not facts.tests or not motors:
        check_compiles(facts)
        check_stop(facts, "log")
        ask_for_files(facts.unknown)
        raise WrongAnswer("the drive callback moves no motor", hint=GETS_VOLTAGE)
    faults = [_find_drive_fault(one, facts, mirrored=mirrored) for one in motors]
    wrong = [one for one in faults if one is not None]
    if wrong:
        wrong[0].earned = round(points * (1 - len(wrong) / len(motors)), 1)
        check_compiles(facts, earned=wrong[0].earned)
        raise wrong[0]
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
    flipped = [one.name for one in motors if _find_voltage_sign(one, facts) == -1]
    if flipped:
        return (
            f"{flipped[0]} gets the other sign. That is right only if it is mounted the other way "
            "round. To invert it where it is made is safer."
        )
    methods = {sent.method for one in motors for sent in _list_sent(one, facts)}
    if "setControl(VoltageOut)" in methods:
        return "setVoltage() sends a VoltageOut, too. Keep one request object and reuse it."
    return None


def _list_driven_tests(motor: DeviceFacts, facts: RoutineFacts) -> dict[str, Driven]:
    name = motor.name
    return {test: run.motors[name] for test, run in facts.tests.items() if name in run.motors}


def _list_sent(motor: DeviceFacts, facts: RoutineFacts) -> list[Sent]:
    """The commands that a motor gets in all tests."""
    return [sent for run in _list_driven_tests(motor, facts).values() for sent in run.sent]


def _find_voltage_sign(motor: DeviceFacts, facts: RoutineFacts) -> int | None:
    """1 or -1 if a motor got the test's voltage with that sign in all tests; else None.

    A test whose voltage nobody knows, as with an unknown ramp, does not count.
    """
    ratios = {run.ratio for run in _list_driven_tests(motor, facts).values() if run.loops}
    signs = {round(ratio) for ratio in ratios if ratio is not None and abs(abs(ratio) - 1) < SAME}
    return signs.pop() if len(signs) == 1 and None not in ratios else None


def _find_drive_fault(
    motor: DeviceFacts, facts: RoutineFacts, *, mirrored: bool
) -> WrongAnswer | None:
    """The fault in the voltages of a motor during the tests; None if there is none."""
    runs = _list_driven_tests(motor, facts)
    bad = {test: run for test, run in runs.items() if run.wrong > FEW}
    fault = next(_list_command_faults(motor, runs, bad), None)
    if fault is not None:
        return fault
    cuts = [(test.endswith("forward"), run.cut) for test, run in bad.items() if run.cut is not None]
    if mirrored and cuts and len(cuts) == len(bad) and _are_limits(cuts):
        return None
    ratio = _find_voltage_sign(motor, facts)
    fault = next(_list_direction_faults(motor, facts, mirrored=mirrored, right=not bad), None)
    if fault is not None or ratio == -1 or not bad or (motor.follows and ratio):
        return fault
    return _describe_voltage(motor.name, bad, runs)


def _find_drive_line(runs: Mapping[str, Driven]) -> int:
    """The first line of the drive callback that sends a motor something; 0 if none does."""
    every = (sent for run in runs.values() for sent in run.sent)
    return next((one.line for one in every if one.phase == "drive"), 0)


def _list_command_faults(
    motor: DeviceFacts, runs: Mapping[str, Driven], bad: Mapping[str, Driven]
) -> Iterator[WrongAnswer]:
    """Faults in the commands that a motor receives, the worst first."""
    name = motor.name
    sent = [one for run in runs.values() for one in run.sent]
    for one in sent:
        if one.kind in {"closed-loop", "current"} and one.phase == "drive":
            yield WrongAnswer(
                f"{name} gets {one.method}{quote(one.line)}: a closed loop, not the voltage",
                hint=UNCHANGED,
                misconception="M-CLOSEDLOOP",
            )
    for run in runs.values():
        if run.unknown:
            yield WrongAnswer(
                explain_doubt(f"what voltage {name} gets", run.unknown),
                hint="Call setVoltage() with the voltage of the callback.",
            )
    if motor.follows == "?":
        yield WrongAnswer(
            f"{name} follows a motor that does not exist{quote(motor.line)}",
            hint="Give the follower the ID of its leader.",
        )
    if runs and all(run.never for run in runs.values()):
        yield WrongAnswer(
            f"{name} gets no voltage in {list_tests(runs)}{quote(motor.line)}",
            hint="Drive every motor. The others have to turn one that gets no voltage, and kS and "
            "kA become too large.",
        )
    others = [one for one in sent if one.phase != "drive" and one.kind != "follow"]
    if others:
        yield _describe_intruder(name, others[-1], bad)
    flipped = [test for test, run in runs.items() if run.flipped]
    if flipped:
        yield WrongAnswer(
            f"{name} changes its inversion during {list_tests(flipped)}",
            hint="Invert a motor once, where it is made.",
        )


def _list_direction_faults(
    motor: DeviceFacts, facts: RoutineFacts, *, mirrored: bool, right: bool
) -> Iterator[WrongAnswer]:
    """Faults in a motor's direction, from following, signs or settings, the worst first.

    Args:
        motor: the motor.
        facts: the run.
        mirrored: whether it may get the other sign.
        right: whether it gets the voltage of every test.
    """
    name, ratio, at = motor.name, _find_voltage_sign(motor, facts), quote(motor.line)
    forward = (ratio or 1) * (-1 if motor.backward else 1)
    if (
        find_side(name, SIDES[0])
        and find_other_side(name, motor.follows)
        and turn_independently(facts.name, SIDES[0])
    ):
        yield WrongAnswer(
            f"{name} follows {motor.follows}{at}",
            hint="A follower turns the gears of its leader's side. Give it the ID of the leader "
            "on its own side.",
        )
    if motor.follows and ratio:
        if motor.mounted and forward < 0:
            yield WrongAnswer(
                f"{name} follows {motor.follows}, and turns its side of the robot backward{at}",
                hint="Choose the other alignment of the follower.",
            )
        return
    if ratio == -1 and (not mirrored or motor.inverted):
        hint = (
            "Nothing here says that this motor is mounted the other way round. If it is, invert it "
            "where it is made, and send both sides the same voltage."
        )
        if motor.inverted and forward > 0:
            hint = "The code inverts this motor as well, and two inversions cancel. Leave one out."
        line = _find_drive_line(_list_driven_tests(motor, facts))
        yield WrongAnswer(f"{name}{quote(line)}: the sign of the voltage is changed", hint=hint)
    if motor.backward and right:
        yield WrongAnswer(
            f"a positive voltage drives {name}'s side backward, by its settings{at}",
            hint="In this task plus is forward on both sides as the file was given. Leave the "
            "inversion as it was.",
        )


def _describe_intruder(name: str, one: Sent, bad: Mapping[str, Driven]) -> WrongAnswer:
    """Words for a command that other code than the drive callback gives during a test."""
    where = {"log": "the log callback", "periodic": "periodic()"}.get(one.phase, "other code")
    method = one.method.partition("(")[0]
    seen = f"{where} calls {method}() on {name}{quote(one.line)} in every loop of a test"
    if bad:
        _, asked, got = next(iter(bad.values())).at
        seen += f": it gets {got:.3g} V when the test asks for {asked:.3g} V"
    hint = "It runs also during a test, and changes the voltage. Let only the drive callback move "
    return WrongAnswer(seen, hint=f"{hint}the motors of a test.")


def _are_limits(cuts: Sequence[tuple[bool, float]]) -> bool:
    """Whether a motor was cut off at the same places, as by the ends of an arm's travel."""
    for way in (True, False):
        found = [position for forward, position in cuts if forward is way]
        if found and max(found) - min(found) > max(A_LOOP, 0.1 * abs(found[0])):
            return False
    return True


def _describe_voltage(
    name: str, bad: Mapping[str, Driven], runs: Mapping[str, Driven]
) -> WrongAnswer:
    """Words for a motor that got another voltage than the test asked for."""
    test, run = next(iter(bad.items()))
    at = quote(_find_drive_line(runs))
    kinds = {sent.kind for one in runs.values() for sent in one.sent if sent.phase == "drive"}
    time, asked, got = run.at
    seen = (
        f"in {test.replace('-', ' ')}, after {time:.1f} s, {name} gets {got:.3g} V when the test "
        f"asks for {asked:.3g} V{at}"
    )
    if run.late:
        hint = "Fill the request first, then send it."
        return WrongAnswer(f"{seen}: each voltage comes a loop late", hint=hint)
    if all(one.never for one in bad.values()) and len(bad) < len(runs):
        hint = f"Every test has to move it, forward and reverse. {UNCHANGED}"
        return WrongAnswer(f"{name} gets no voltage in {list_tests(bad)}{at}", hint=hint)
    shares = [abs(one.ratio) if one.ratio is not None else math.inf for one in runs.values()]
    same = max(shares) - min(shares) < SAME
    nominal = next((one for one in NOMINAL if same and abs(shares[0] * one - 1.0) < SAME), 0.0)
    if nominal and kinds == {"voltage"}:
        seen += f": a share of {nominal:g} V, sent as volts"
        return WrongAnswer(seen, hint=UNCHANGED, misconception="M-DUTY")
    if kinds == {"duty"} and not any(one.method.startswith("setVoltage") for one in run.sent):
        seen += ": a duty cycle, a share of the battery"
        return WrongAnswer(seen, hint=UNCHANGED, misconception="M-DUTY")
    steady = len({round(one.at[2], 2) for one in bad.values()}) == 1 < len(bad)
    if steady and all(one.ratio is None or test.startswith("dyn") for test, one in bad.items()):
        return WrongAnswer(
            f"{seen}: it always gets {got:.3g} V",
            hint="That does not depend on the test. Send the voltage that the callback gets. The "
            "routine ends a test by sending 0 V, so this motor would drive on after the button is "
            "released.",
        )
    return WrongAnswer(seen, hint=f"Your code changes the voltage. {UNCHANGED}")


def check_open_loop(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` if the drive callback uses a closed loop or a duty cycle."""
    sent = [
        one
        for motor in (list_driven(facts) if facts.drive else ())
        for one in _list_sent(motor, facts)
        if one.phase == "drive"
    ]
    if not sent:
        check_compiles(facts)
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
            hint=f"{OWNER.format(this)} Without a subsystem the program stops as it starts.",
        )
    if facts.requires == "other" and facts.is_subsystem:
        raise WrongAnswer(
            f"the tests require another subsystem than {facts.name}{quote(facts.line)}",
            hint=OWNER.format(this),
        )
    check_devices(facts)
    check_compiles(facts)
    check_stop(facts)


def check_devices(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` if two devices share a port or CAN ID, or one has an impossible one."""
    seen: dict[str, DeviceFacts] = {}
    for one in facts.devices:
        if one.number is not None and one.number < 0:
            raise WrongAnswer(
                f"{one.name} is made with {one.number:g}{quote(one.line)}",
                hint="This number is not a port or a CAN ID. Check the wiring.",
            )
        place = f"{one.type} {one.port}" if one.port.startswith("CAN") else one.port
        other = seen.setdefault(place, one)
        if one.port and other is not one:
            raise WrongAnswer(
                f"{other.name} and {one.name} are made with the same number{quote(one.line)}",
                hint="Two devices cannot share a port or a CAN ID. Did you copy a line and forget "
                "to change it?",
            )
