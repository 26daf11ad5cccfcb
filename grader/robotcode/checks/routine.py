"""Checks of a SysIdRoutine: its Config, the voltages that its motors get, and its parts."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from grader.checks.check import NotReachedError, WrongAnswer
from grader.robotcode.bench.facts import DeviceFacts, Driven, RoutineFacts, Sent, Setting
from grader.robotcode.checks.causes import (
    ask_for_files,
    check_compiles,
    check_stop,
    check_swapped,
    explain_doubt,
    fault,
    list_tests,
    quote,
)
from grader.robotcode.checks.motor_names import (
    SIDES,
    find_other_side,
    find_side,
    turn_independently,
)

TARGETS = frozenset({"closed-loop", "current"})  # commands that are no voltage, but a target
FEW = 2  # loops that may differ: the first of a test, and one more
SAME = 0.02  # [share] what two ratios of voltages may differ in that are the same
A_LOOP = 0.5  # [rot] that a motor may turn in a loop, before a limit stops it
PATIENCE = 0.04  # [s] a callback may keep the loop waiting
NOMINAL = (12.0, 12.5, 13.0, 10.0)  # [V] by which programs divide a voltage to get a duty cycle

Advice = Callable[[float], tuple[str, str]]


def check_routine_found(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` unless the subsystem makes a SysIdRoutine and keeps it."""
    if not facts.line:
        check_compiles(facts)
        check_stop(facts, "start", "command")
        ask_for_files(facts.unknown)
        raise fault("no_routine")
    if not facts.kept:
        raise fault("not_kept", facts.line)


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
            raise fault("unknown_setting", doubt=explain_doubt(f"the {self.name}", got.text))
        seen = f"{got.value:g} {self.unit}"
        if got.default:
            seen = f"left to WPILib's default, {seen}"
        if math.isclose(got.value, self.value, rel_tol=1e-9):
            note = f"This is {seen}. Write the number anyway: a default may change."
            return note if got.default else None
        said, misconception = advice(got.value)
        if got.value == 0 and facts.language == "java":
            said = "Did you divide whole numbers? In Java, 1 / 2 is 0."
        hint = f"{said} {asks}".strip()
        raise WrongAnswer(f"{seen}{quote(got.line)}", hint=hint, misconception=misconception)


def list_driven(facts: RoutineFacts) -> list[DeviceFacts]:
    """The motors that the test has to move.

    While a swerve drive goes straight, a closed loop holds its steering: such a motor gets closed
    loops in every test and no voltage, and others of the subsystem are driven. A motor whose
    mounting the task describes is no steering motor.
    """
    motors = list(facts.motors.values())
    kinds = {one.name: {sent.kind for sent in _list_sent(one, facts)} for one in motors}
    if not any(kinds[one.name] & {"voltage", "duty"} for one in motors):
        return motors
    return [
        one for one in motors if one.follows or one.mounted or kinds[one.name] != {"closed-loop"}
    ]


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
        raise fault("no_drive")
    check_swapped(facts)
    check_stop(facts, "drive", "command", "periodic", "start")
    motors = list_driven(facts)
    if not facts.tests or not motors:
        check_compiles(facts)
        check_stop(facts, "log")
        ask_for_files(facts.unknown)
        raise fault("moves_nothing")
    faults = [_find_drive_fault(one, facts, mirrored=mirrored) for one in motors]
    wrong = [one for one in faults if one is not None]
    if wrong:
        wrong[0].earned = round(points * (1 - len(wrong) / len(motors)), 1)
        check_compiles(facts, earned=wrong[0].earned)
        raise wrong[0]
    for name, test in facts.tests.items():
        if test.blocked > PATIENCE:
            raise fault(
                "waits",
                seconds=test.blocked,
                test=name.replace("-", " "),
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
        if one.kind in TARGETS and one.phase == "drive":
            yield fault("sends_closed_loop", one.line, name=name, method=one.method)
    for run in runs.values():
        if run.unknown:
            doubt = explain_doubt(f"what voltage {name} gets", run.unknown)
            yield fault("unknown_voltage", doubt=doubt)
    if motor.follows == "?":
        yield fault("no_leader", motor.line, name=name)
    if runs and all(run.never for run in runs.values()):
        yield fault("never_driven", motor.line, name=name, tests=list_tests(runs))
    others = [one for one in sent if one.phase != "drive" and one.kind != "follow"]
    if others:
        yield _describe_intruder(name, others[-1], bad)
    flipped = [test for test, run in runs.items() if run.flipped]
    if flipped:
        yield fault("inversion_changes", name=name, tests=list_tests(flipped))


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
    name, ratio = motor.name, _find_voltage_sign(motor, facts)
    forward = (ratio or 1) * (-1 if motor.backward else 1)
    if (
        find_side(name, SIDES[0])
        and find_other_side(name, motor.follows)
        and turn_independently(facts.name, SIDES[0])
    ):
        yield fault("leader_of_other_side", motor.line, name=name, leader=motor.follows)
    if motor.follows and ratio:
        if motor.mounted and forward < 0:
            yield fault("follower_backward", motor.line, name=name, leader=motor.follows)
        return
    if ratio == -1 and (not mirrored or motor.inverted):
        kind = "inverted_twice" if motor.inverted and forward > 0 else "sign_changed"
        yield fault(kind, _find_drive_line(_list_driven_tests(motor, facts)), name=name)
    if motor.backward and right:
        yield fault("drives_backward", motor.line, name=name)


def _describe_intruder(name: str, one: Sent, bad: Mapping[str, Driven]) -> WrongAnswer:
    """Words for a command that other code than the drive callback gives during a test."""
    where = {"log": "the log callback", "periodic": "periodic()"}.get(one.phase, "other code")
    method = one.method.partition("(")[0]
    got = ""
    if bad:
        _, asked, volts = next(iter(bad.values())).at
        got = f": it gets {volts:.3g} V when the test asks for {asked:.3g} V"
    return fault("driven_by_other_code", one.line, where=where, method=method, name=name, got=got)


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
    sent = [one for each in runs.values() for one in each.sent if one.phase == "drive"]
    kinds = {one.kind for one in sent}
    time, asked, got = run.at
    shares = [abs(one.ratio) if one.ratio is not None else math.inf for one in runs.values()]
    same = max(shares) - min(shares) < SAME
    nominal = next((one for one in NOMINAL if same and abs(shares[0] * one - 1.0) < SAME), 0.0)
    alike = len({round(one.at[2], 2) for one in bad.values()}) == 1 < len(bad)
    kind = "another_voltage"
    if run.late:
        kind = "comes_late"
    elif all(one.never for one in bad.values()) and len(bad) < len(runs):
        kind = "not_in_every_test"
    elif nominal and kinds == {"voltage"}:
        kind = "share_as_volts"
    elif kinds == {"duty"} and not any(one.method.startswith("setVoltage") for one in sent):
        kind = "sends_duty_cycle"
    elif alike and all(one.steady for one in bad.values()):
        kind = "always_the_same"
    return fault(
        kind, _find_drive_line(runs), test=test.replace("-", " "), tests=list_tests(bad), name=name,
        time=time, asked=asked, got=got, nominal=nominal,
    )  # fmt: skip


def list_drive_commands(facts: RoutineFacts) -> list[Sent]:
    """What the drive callback sends to the motors, in all tests."""
    return [
        one
        for motor in (list_driven(facts) if facts.drive else ())
        for one in _list_sent(motor, facts)
        if one.phase == "drive"
    ]


def check_open_loop(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` if the drive callback uses a closed loop or a duty cycle."""
    sent = list_drive_commands(facts)
    if not sent:
        check_compiles(facts)
        raise NotReachedError("checked after the drive callback moves a motor")
    for one in sent:
        if one.kind == "duty" and not one.method.startswith("setVoltage"):
            raise fault("uses_duty_cycle", one.line, method=one.method)
        if one.kind in TARGETS:
            raise fault("uses_closed_loop", one.line, method=one.method)


def check_assembled(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` unless a ``SysIdRoutine`` gets Config, Mechanism, subsystem."""
    this = "this" if facts.language == "java" else "self"
    if facts.swapped:
        raise fault("routine_swapped", facts.line)
    if not facts.is_subsystem and facts.requires != "other":
        raise fault("no_subsystem", name=facts.name)
    if facts.requires == "none":
        raise fault("no_owner", this=this)
    if facts.requires == "other" and facts.is_subsystem:
        raise fault("other_owner", facts.line, this=this, name=facts.name)
    check_devices(facts)
    check_compiles(facts)
    check_stop(facts)


def check_devices(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` if two devices share a port or CAN ID, or one has an impossible one."""
    seen: dict[str, DeviceFacts] = {}
    for one in facts.devices:
        if one.number is not None and one.number < 0:
            raise fault("negative_port", one.line, name=one.name, number=one.number)
        place = f"{one.type} {one.port}" if one.port.startswith("CAN") else one.port
        other = seen.setdefault(place, one)
        if one.port and other is not one:
            raise fault("same_port", one.line, other=other.name, name=one.name)
