"""Checks of what a SysIdRoutine logs: the right signals of each motor, and their units."""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from grader.check import NotReachedError, WrongAnswer
from grader.robotcode.bench.facts import DeviceFacts, RoutineFacts, Signal
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
    find_motion_family,
    find_other_side,
    find_side,
    turn_independently,
)
from grader.robotcode.checks.routine import FEW, check_swapped, list_driven
from grader.robotcode.library.world import GEARING

NEEDED = ("voltage", "position", "velocity")  # of every motor, for a fit
MOVING = ("position", "velocity")
SHARE = {"voltage": 1 / 2, "position": 1 / 6, "velocity": 1 / 6}  # of the log's points
MANY = 6  # no robot has more motors in a log
NEAR = 2e-3  # [share] how well a factor is known
PWM_STEP = 0.01  # [share] by which a voltage of a PWM motor may be off
LONGEST = 2.0  # [m] no wheel or drum lays so much behind it in one rotation of its motor
LARGE = 1000.0  # [m] from here on a length is written without decimals
APPLIED = (
    "Log the voltage that the motor got: getMotorVoltage(), getAppliedOutput() times the bus "
    "voltage, or in Python getVoltage()."
)
SIGNED = "Half of the tests run backward. Log the number with its sign."
EACH_TIME = "Record every signal each time the callback is called, without a condition."
COPIED = "Did you copy a line and forget to change it?"
OWN_VALUES = f"{COPIED} Log for {{}} the values of its own motor and its own encoder."
SLIPS = {  # what a velocity is of the slope of its position, and how that comes about
    60.0: "One is per minute, the other per second",
    2 * math.pi: "One is in radians, the other in rotations",
    360.0: "One is in degrees, the other in rotations",
    180 / math.pi: "One is in degrees, the other in radians",
}
REPORTS = {"position": "rotations", "velocity": "rotations per second"}

Logged = Mapping[str, Mapping[str, list[Signal]]]  # name in the log -> signal -> in each test
Faults = Iterator[tuple[str, WrongAnswer]]  # each with the signal that it is about


def list_signals(facts: RoutineFacts) -> Logged:
    """Name in the log -> signal -> its facts in each test."""
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
        seen = "null instead of the log callback: then WPILib records nothing"
        hint = "null is for robots whose motors a vendor's logger or AdvantageKit records."
        if facts.language == "python":
            seen = (
                "None in place of the log callback: RobotPy stops with a TypeError in the first "
                "loop"
            )
            hint = "Where a vendor's logger records the motors, write `lambda log: None`."
        raise WrongAnswer(seen, hint=f"{hint} Here, write a callback that fills the log.")
    check_swapped(facts)
    check_stop(facts)
    there = list_signals(facts)
    if not there:
        check_compiles(facts)
        ask_for_files(facts.unknown)
        raise WrongAnswer(
            "the log callback records nothing",
            hint='It gets a log: log.motor("left"), then voltage, position and velocity.',
        )
    faults = list(_find_log_faults(facts, there))
    if faults:
        lost = {signal: SHARE.get(signal.rpartition(" ")[2], 1 / 6) for signal, _ in faults}
        (_, worst), *_ = faults
        worst.earned = max(round(points * (1 - sum(lost.values())), 1), 0.0)
        check_compiles(facts, earned=worst.earned)
        raise worst
    _check_all_logged(facts, there, demanded=demanded, points=points)


def _find_log_faults(facts: RoutineFacts, there: Logged) -> Faults:
    """Each fault with the signal that it is about."""
    for name, signals in there.items():
        yield from _find_name_faults(name, signals, facts)
        for signal in NEEDED:
            many = signals.get(signal, [])
            if len({one.scale > 0 for one in many if one.scale}) > 1:  # forward and reverse differ
                many = [replace(one, absolute=True) for one in many]
            faults = (fault for one in many for fault in _list_signal_faults(name, signal, one))
            if fault := next(faults, None):
                yield f"{name} {signal}", fault
    loops = sum(test.logs for test in facts.tests.values())
    rows = {name: sum(one.loops for one in s.get("voltage", [])) for name, s in there.items()}
    few = [name for name, count in rows.items() if 0 < count < loops - FEW * len(facts.tests)]
    if few and (len(there) > MANY or len(few) == len(there)):
        said = f"{few[0]} is logged in {rows[few[0]]} of {loops} loops"
        if len(there) > MANY:
            said = f"{len(there)} names are in the log"
        hint = "Record every motor in every loop, always under the same name."
        yield f"{few[0]} voltage", WrongAnswer(said, hint=hint)
    owners = {name: _find_owners(name, signals) for name, signals in there.items()}
    for name in owners:
        yield from _find_wrong_owners(name, owners, there[name])


def _find_name_faults(
    name: str, signals: Mapping[str, list[Signal]], facts: RoutineFacts
) -> Faults:
    """Faults in the number of signals and of rows under one name."""
    lacking = [signal for signal in NEEDED if signal not in signals]
    hint = "A fit needs all three of every motor: voltage, position and velocity."
    if lacking == ["position"]:
        hint = (
            "SysId's window refuses a motor without a position. (For a drivetrain, our own fit "
            "gets by with voltage and velocity; an arm's or elevator's needs the position.)"
        )
    for signal in lacking:
        seen = f"no {' and no '.join(lacking)} of {name}"
        yield f"{name} {signal}", WrongAnswer(seen, hint=hint)
    loops = {one: sum(s.loops for s in signals[one]) for one in NEEDED if one in signals}
    logs = sum(test.logs for test in facts.tests.values())
    least = min(loops, key=lambda key: loops[key], default="")
    if not least or loops[least] >= logs - FEW * len(facts.tests):
        return
    at = quote(signals[least][0].line)
    seen = f"{name}'s {least} is logged in {loops[least]} of {logs} loops{at}"
    if loops[least] == max(loops.values()):
        silent = [
            test
            for test, run in facts.tests.items()
            if run.signals.get(name, {}).get(least, Signal()).loops < run.logs - FEW
        ]
        if not silent or len(facts.tests) == 1:
            return
        seen = f"{name} is not logged in all loops of {list_tests(silent)}{at}"
    yield f"{name} {least}", WrongAnswer(seen, hint=EACH_TIME)


def _list_signal_faults(name: str, signal: str, one: Signal) -> Iterator[WrongAnswer]:
    """Faults of a signal in the log, the worst first."""
    at = quote(one.line)
    if one.twice:
        yield WrongAnswer(
            f"{name}'s {signal} is written more than once in a loop{at}",
            hint="Only one motor may log under a name. Is the name of the second one copied, too?",
        )
    if one.idle and not one.unknown:
        return
    if one.unknown:
        yield WrongAnswer(
            explain_doubt(f"where the {signal} of {name} comes from", f"{one.unknown}{at}"),
            hint="Ask the motor itself for it, in the log callback, and hand in every file it "
            "needs.",
        )
    listed = _list_voltage_faults if signal == "voltage" else _list_motion_faults
    yield from listed(name, signal, one)


def _list_voltage_faults(name: str, _signal: str, one: Signal) -> Iterator[WrongAnswer]:
    """Faults of a logged voltage, the worst first."""
    at = quote(one.line)
    if one.asked:
        yield WrongAnswer(
            f"{name}'s voltage is the commanded voltage{at}: it stays the same when the motor gets "
            "less",
            hint=APPLIED,
            misconception="M-CMDVOLT",
        )
    if one.battery and not one.follows:
        yield WrongAnswer(
            f"{name}'s voltage is the voltage of the battery{at}",
            hint=f"The motor gets only a part of it. {APPLIED}",
        )
    if one.absolute:
        yield WrongAnswer(f"the voltage of {name} loses its sign{at}", hint=SIGNED)
    if not one.follows:
        yield WrongAnswer(f"{name}'s voltage follows no motor's voltage{at}", hint=APPLIED)
    if one.scale is not None and abs(one.scale - 1.0) > PWM_STEP:
        motor = one.follows.partition(" ")[2]
        seen = f"{name}'s voltage is {one.scale:.3g} times that of {motor}{at}"
        yield WrongAnswer(seen, hint=APPLIED)


def _list_motion_faults(name: str, signal: str, one: Signal) -> Iterator[WrongAnswer]:
    """Faults of a logged position or velocity, the worst first."""
    at, (part, _, motor) = quote(one.line), one.follows.partition(" ")
    if one.still:
        yield WrongAnswer(
            f"{name}'s {signal} stays {one.values[0]:.3g} while the motor turns{at}",
            hint="Something resets it in every loop, or it was read only once. Read the sensor in "
            "the callback (a status signal that is kept needs refresh()), and reset nothing in a "
            "test.",
        )
    if not part:
        yield WrongAnswer(
            f"{name}'s {signal} follows no motor's {signal}{at}",
            hint="Log what the sensor says now, converted by one factor. Do not filter, round or "
            "average it.",
        )
    if part != signal:
        yield WrongAnswer(
            f"the {signal} of {name} is the {part} of {motor}{at}",
            hint=f"Log the {signal} there: each value has its own method.",
        )
    if one.absolute:
        yield WrongAnswer(f"the {signal} of {name} loses its sign{at}", hint=SIGNED)
    if signal == "velocity" and one.scale and abs(one.offset) > NEAR * 10 * abs(one.scale):
        yield WrongAnswer(
            f"{name}'s velocity is {one.offset:.3g} too large all the time{at}",
            hint="An offset in the velocity makes kS wrong. Log the sensor's number.",
        )


def _find_wrong_owners(
    name: str, owners: Mapping[str, Mapping[str, str]], signals: Mapping[str, list[Signal]]
) -> Faults:
    """Signals under one name that belong to the motor of another name, or to several motors.

    Args:
        name: in the log.
        owners: name in the log -> signal -> its motor.
        signals: what is logged under the name.
    """
    mine, theirs = owners[name], {other: owners[other] for other in owners if other != name}
    if not mine:
        return
    at = {signal: quote(signals[signal][0].line) for signal in signals}
    (first, motor), *rest = mine.items()
    whole, other_side = len(set(mine.values())) == 1, find_other_side(name, motor)
    named = any(set(one.values()) == {motor} for one in theirs.values())
    if whole and other_side and len(mine) == len(NEEDED) and not named:
        seen = f"everything that is logged under the name {name} is of {motor}{at[first]}"
        hint = f"The values are right for {motor}, so the name is wrong. {COPIED}"
        yield f"{name} {first}", WrongAnswer(seen, hint=hint)
        return
    for signal, owner in mine.items():
        wrong = find_other_side(name, owner)
        others = [other for other, one in theirs.items() if one.get(signal) == owner]
        seen = f"{name} gets the {signal} of {owner}{at[signal]}"
        if wrong:
            hint = f"{COPIED} Under the name {name}, log the values of the {wrong} motor."
            yield f"{name} {signal}", WrongAnswer(seen, hint=hint)
        elif others and not whole:
            hint = OWN_VALUES.format(name)
            yield f"{name} {signal}", WrongAnswer(f"{seen}, and so does {others[0]}", hint=hint)
    if not whole and not any(find_other_side(name, owner) for owner in mine.values()):
        signal, owner = next(pair for pair in rest if pair[1] != motor)
        seen = f"the {signal} of {name} comes from {owner}, its {first} from {motor}{at[signal]}"
        hint = "All three signals of a motor must come from the same motor."
        yield f"{name} {signal}", WrongAnswer(seen, hint=hint)
    before = itertools.takewhile(lambda other: other != name, owners)
    twin = next((one for one in before if {*owners[one].values()} == {motor}), None)
    if whole and twin is not None and not other_side:
        seen = f"{twin} and {name} are the same motor: {motor}{at.get('voltage', '')}"
        yield f"{name} voltage", WrongAnswer(seen, hint=OWN_VALUES.format(name))


def _find_owners(name: str, signals: Mapping[str, list[Signal]]) -> dict[str, str]:
    """Signal -> its motor; where it could be of several, the one that agrees with the rest."""
    could = {
        signal: set.intersection(
            *[set(one.owners) for one in many if one.owners or one.follows] or [set()]
        )
        for signal, many in signals.items()
        if signal in NEEDED
    }
    sure = [next(iter(one)) for one in could.values() if len(one) == 1]
    named = [one for motors in could.values() for one in motors if not find_other_side(name, one)]
    best = [*sure, *named]
    return {
        signal: next((one for one in best if one in motors), min(motors))
        for signal, motors in could.items()
        if motors
    }


def _check_all_logged(facts: RoutineFacts, there: Logged, *, demanded: int, points: float) -> None:
    """Raise ``WrongAnswer`` unless every driven motor, or each side of a drivetrain, is logged."""
    driven = [one for one in list_driven(facts) if not one.follows]
    logged = {
        one[0].follows.partition(" ")[2] for signals in there.values() for one in signals.values()
    }
    hint = (
        "The Mechanism drives two sides, and each has its own friction. Log every motor, each "
        "under its own name."
    )
    for pair in SIDES:
        sides = {find_side(one.name, pair) for one in driven} - {""}
        told = {find_side(text, pair) for text in (*there, *logged)} - {""}
        if (
            len(sides) > 1
            and told & sides
            and sides - told
            and turn_independently(facts.name, pair)
        ):
            seen = f"no {min(sides - told)} motor in the log"
            raise WrongAnswer(seen, hint=hint, earned=round(points / 2, 1))
    if len(there) < min(demanded, len(driven)):
        seen = f"{len(there)} of {len(driven)} motors in the log"
        raise WrongAnswer(seen, hint=hint, earned=round(points * len(there) / len(driven), 1))


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
        check_compiles(facts)
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
    devices = {one.name: one for one in facts.devices}
    for (name, signal), one in moving.items():
        _check_scale(name, signal, one, devices, scales)
    _check_gearing([devices.get(one.follows.partition(" ")[2]) for one in moving.values()])
    for name in there:
        _check_rate(name, moving.get((name, "position")), moving.get((name, "velocity")))
    for signal in MOVING:
        _check_alike([(name, one) for (name, kind), one in moving.items() if kind == signal])
    _check_signs(there)


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
    at, scale = quote(one.line), abs(one.scale)
    if not sensor:
        _check_reported(
            f"{name}'s {signal}{at}: {device.name}", signal, one, scale * device.gearing
        )
    wanted = scales.get(device.type, scales.get(sensor.type if sensor else "", 0.0))
    if one.family == "linear" and scale > LONGEST and (not sensor or wanted):
        length = f"{scale:.3g}" if scale < LARGE else f"{scale:.0f}"
        _raise_unit(
            f"{name}'s {signal}{at}: one rotation of {device.name} counts as {length} m",
            f"One rotation would be {length} m. Multiply by the meters of one rotation, and by "
            "nothing else; do not divide by them.",
        )
    if one.family == "linear" and wanted and not _close(scale, wanted):
        _raise_unit(
            f"{name}'s {signal}{at}: one rotation counts as {scale:.4g} m, and by the task's own "
            f"number it is {wanted:.4g} m",
            "Multiply by the task's number exactly once, and apply no other ratio.",
        )


def _check_reported(motor: str, signal: str, one: Signal, turn: float) -> None:
    """Whether a logged number is a converted reading of the motor.

    Args:
        motor: the signal and its motor, in words.
        signal: ``position`` or ``velocity``.
        one: the signal.
        turn: what is logged for one rotation as the motor reports it, in SI.
    """
    reports, rpm = REPORTS[signal], "rotations per minute"
    if one.family == "linear":
        says = f"and the log says {one.unit or 'meters'}"
        hint = "Multiply by the meters of one rotation: wheel's circumference over gear ratio."
        taken = {1.0: f"{reports}, {says}"}
        rates = {60.0: f"{rpm}, {says}"}
    elif one.family == "angular":
        says = f"and the log says {one.unit or 'an angle'}"
        hint = "Name the unit that the number is in, and a measure converts itself."
        taken = dict.fromkeys((1.0, 2 * math.pi / 360), f"{reports}, {says}")
        rates = {
            2 * math.pi * 60: f"{rpm}, and the log takes them for {reports}",
            2 * math.pi / 60: f"{reports}, and the log takes them for {rpm}",
        }
    else:
        return
    for factor, what in (taken | (rates if signal == "velocity" else {})).items():
        if _close(turn, factor):
            plain = "The unit's name around a number converts nothing."
            _raise_unit(f"{motor} reports {what}", f"{plain} {hint}")


def _close(one: float, other: float) -> bool:
    return abs(one / other - 1.0) < NEAR


def _check_gearing(logged: Sequence[DeviceFacts | None]) -> None:
    """Whether all logged motors report rotations of the mechanism, or none does."""
    motors = [one for one in logged if one is not None]
    bare = next((one for one in motors if one.gearing == 1.0), None)
    for one in motors:
        if bare and one.gearing != 1.0 and one.type == bare.type:
            _raise_unit(
                f"{bare.name} gets no configuration, so it reports rotations of the motor; "
                f"{one.name} reports those of the mechanism",
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
        hint = "One of the two has the wrong sign. Log both with the same sign."
        raise WrongAnswer(seen, hint=hint)
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
    sided = [(name, one) for name, one in signals if find_side(name, SIDES[0]) and one.scale]
    for (name, one), (other, second) in itertools.pairwise(sided):
        ratio = abs((second.scale or 1.0) / (one.scale or 1.0))
        if not _close(ratio, 1.0) and one.family == second.family:
            _raise_unit(
                f"a rotation of {other} counts {ratio:.4g} times what one of {name} "
                f"counts{quote(second.line)}",
                "Both sides have the same wheels and gears. Convert both in the same way.",
            )


def _check_signs(there: Logged) -> None:
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
