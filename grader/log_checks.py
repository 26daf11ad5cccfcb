"""Checks of what a SysIdRoutine logs: the right signals of each motor, and their units."""

import itertools
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from grader.check import NotReachedError, WrongAnswer
from grader.robotcode.bench.facts import (
    DeviceFacts,
    RoutineFacts,
    Signal,
)
from grader.robotcode.library.world import GEARING
from grader.routine_checks import (
    ANGULAR,
    FEW,
    LINEAR,
    SIDES,
    Fault,
    ask_for_files,
    check_compiles,
    check_stop,
    check_swapped,
    explain_doubt,
    find_other_side,
    find_side,
    list_driven,
    list_tests,
    quote,
    split_words,
    turn_independently,
)

NEEDED = ("voltage", "position", "velocity")  # of every motor, for a fit
MOVING = ("position", "velocity")
SHARE = {"voltage": 1 / 2, "position": 1 / 6, "velocity": 1 / 6}  # of the log's points
MANY = 6  # no robot has more motors in a log
NEAR = 2e-3  # [share] how well a factor is known
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
REPORTS = {"position": "rotations", "velocity": "rotations per second"}


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
    check_swapped(facts)
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
            wrong = find_other_side(name, motor)
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
        find_other_side(name, motor) for motor in mine.values()
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
        if twin is not None and not find_other_side(name, motor):
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
    named = [one for motors in could.values() for one in motors if not find_other_side(name, one)]
    best = [*sure, *named]
    return {
        signal: next((one for one in best if one in motors), min(motors))
        for signal, motors in could.items()
        if motors
    }


def _check_all_logged(
    facts: RoutineFacts, there: dict[str, dict[str, list[Signal]]], *, demanded: int, points: float
) -> None:
    """Raise ``WrongAnswer`` unless every driven motor, or each side of a drivetrain, is logged."""
    driven = [one for one in list_driven(facts) if not one.follows]
    logged = {
        one[0].follows.partition(" ")[2] for signals in there.values() for one in signals.values()
    }
    for pair in SIDES:
        sides = {find_side(one.name, pair) for one in driven} - {""}
        told = {find_side(text, pair) for text in (*there, *logged)} - {""}
        if len(sides) > 1 and told & sides and sides - told and turn_independently(facts, pair):
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


def find_motion_family(name: str) -> str:
    """The motion of a mechanism of this name, ``linear`` or ``angular``; empty if unknown."""
    words = split_words(name)
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
    sided = [(name, one) for name, one in signals if find_side(name, SIDES[0]) and one.scale]
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
