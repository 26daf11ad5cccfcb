"""Checks of what a SysIdRoutine logs: the right signals of each motor, and their units."""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from grader.checks.check import NotReachedError, WrongAnswer
from grader.robotcode.bench.facts import DeviceFacts, RoutineFacts, Signal
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
    find_motion_family,
    find_other_side,
    find_side,
    turn_independently,
)
from grader.robotcode.checks.routine import FEW, TARGETS, list_drive_commands, list_driven
from grader.robotcode.library.world import GEARING

NEEDED = ("voltage", "position", "velocity")  # of every motor, for a fit
MOVING = ("position", "velocity")
SHARE = {"voltage": 1 / 2, "position": 1 / 6, "velocity": 1 / 6}  # of the log's points
MANY = 6  # no robot has more motors in a log
NEAR = 2e-3  # [share] how well a factor is known
PWM_STEP = 0.01  # [share] by which a voltage of a PWM motor may be off
LONGEST = 2.0  # [m] no wheel or drum lays so much behind it in one rotation of its motor
LARGE = 1000.0  # [m] from here on a length is written without decimals
SLIPS = {  # what a velocity is of the slope of its position, and how that comes about
    60.0: "Is one per minute, the other per second?",
    2 * math.pi: "Is one in radians, the other in rotations?",
    360.0: "Is one in degrees, the other in rotations?",
    180 / math.pi: "Is one in degrees, the other in radians?",
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
        raise fault("none_log" if facts.language == "python" else "null_log")
    check_swapped(facts)
    check_stop(facts)
    there = list_signals(facts)
    if not there:
        check_compiles(facts)
        ask_for_files(facts.unknown)
        if facts.tests and not any(test.logs for test in facts.tests.values()):
            raise NotReachedError("checked after your tests last long enough to log something")
        raise fault("logs_nothing")
    faults = list(_find_log_faults(facts, there))
    if faults:
        lost = {signal: SHARE.get(signal.rpartition(" ")[2], 1 / 6) for signal, _ in faults}
        (signal, worst), *_ = faults
        targets = any(one.kind in TARGETS for one in list_drive_commands(facts))
        if targets and signal.endswith("voltage"):  # nobody knows the volts of a closed loop
            raise NotReachedError("checked after the drive callback sends its voltage")
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
            found = (wrong for one in many for wrong in _list_signal_faults(name, signal, one))
            if worst := next(found, None):
                yield f"{name} {signal}", worst
    loops = sum(test.logs for test in facts.tests.values())
    rows = {name: sum(one.loops for one in s.get("voltage", [])) for name, s in there.items()}
    few = [name for name, count in rows.items() if 0 < count < loops - FEW * len(facts.tests)]
    if few and (len(there) > MANY or len(few) == len(there)):
        kind = "too_many_names" if len(there) > MANY else "logged_rarely"
        yield (
            f"{few[0]} voltage",
            fault(kind, count=len(there), name=few[0], rows=rows[few[0]], loops=loops),
        )
    owners = {name: _find_owners(name, signals) for name, signals in there.items()}
    for name in owners:
        yield from _find_wrong_owners(name, owners, there[name])


def _find_name_faults(
    name: str, signals: Mapping[str, list[Signal]], facts: RoutineFacts
) -> Faults:
    """Faults in the number of signals and of rows under one name."""
    lacking = [signal for signal in NEEDED if signal not in signals]
    kind = "lacks_position" if lacking == ["position"] else "lacks_signals"
    for signal in lacking:
        yield f"{name} {signal}", fault(kind, lacking=" and no ".join(lacking), name=name)
    loops = {one: sum(s.loops for s in signals[one]) for one in NEEDED if one in signals}
    logs = sum(test.logs for test in facts.tests.values())
    least = min(loops, key=lambda key: loops[key], default="")
    if not least or loops[least] >= logs - FEW * len(facts.tests):
        return
    kind, silent = "signal_logged_rarely", []
    if loops[least] == max(loops.values()):
        kind = "silent_in_tests"
        silent = [
            test
            for test, run in facts.tests.items()
            if run.signals.get(name, {}).get(least, Signal()).loops < run.logs - FEW
        ]
        if not silent or len(facts.tests) == 1:
            return
    yield f"{name} {least}", fault(
        kind, signals[least][0].line, name=name, signal=least, count=loops[least], logs=logs,
        tests=list_tests(silent),
    )  # fmt: skip


def _list_signal_faults(name: str, signal: str, one: Signal) -> Iterator[WrongAnswer]:
    """Faults of a signal in the log, the worst first."""
    if one.twice:
        yield fault("written_twice", one.line, name=name, signal=signal)
    if one.idle and not one.unknown:
        return
    if one.unknown:
        where = f"where the {signal} of {name} comes from"
        yield fault("unknown_source", doubt=explain_doubt(where, f"{one.unknown}{quote(one.line)}"))
    listed = _list_voltage_faults if signal == "voltage" else _list_motion_faults
    yield from listed(name, signal, one)


def _list_voltage_faults(name: str, _signal: str, one: Signal) -> Iterator[WrongAnswer]:
    """Faults of a logged voltage, the worst first."""
    if one.asked:
        yield fault("commanded_voltage", one.line, name=name)
    if one.battery and not one.follows:
        yield fault("battery_voltage", one.line, name=name)
    if one.absolute:
        yield fault("loses_sign", one.line, name=name, signal="voltage")
    if not one.follows:
        yield fault("follows_no_voltage", one.line, name=name)
    if one.scale is not None and abs(one.scale - 1.0) > PWM_STEP:
        motor = one.follows.partition(" ")[2]
        yield fault("scaled_voltage", one.line, name=name, one=one, motor=motor)


def _list_motion_faults(name: str, signal: str, one: Signal) -> Iterator[WrongAnswer]:
    """Faults of a logged position or velocity, the worst first."""
    part, _, motor = one.follows.partition(" ")
    if one.still:
        yield fault("stays_still", one.line, name=name, signal=signal, one=one)
    if not part:
        yield fault("follows_nothing", one.line, name=name, signal=signal)
    if part != signal:
        yield fault("other_signal", one.line, name=name, signal=signal, part=part, motor=motor)
    if one.absolute:
        yield fault("loses_sign", one.line, name=name, signal=signal)
    if signal == "velocity" and one.scale and abs(one.offset) > NEAR * 10 * abs(one.scale):
        yield fault("velocity_offset", one.line, name=name, one=one)


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
    at = {signal: one[0].line for signal, one in signals.items()}
    (first, motor), *rest = mine.items()
    whole, other_side = len(set(mine.values())) == 1, find_other_side(name, motor)
    named = any(set(one.values()) == {motor} for one in theirs.values())
    if whole and other_side and len(mine) == len(NEEDED) and not named:
        yield f"{name} {first}", fault("wrong_name", at[first], name=name, motor=motor)
        return
    for signal, owner in mine.items():
        wrong = find_other_side(name, owner)
        others = [other for other, one in theirs.items() if one.get(signal) == owner]
        told: dict[str, Any] = {"name": name, "signal": signal, "motor": owner}
        if wrong:
            yield f"{name} {signal}", fault("other_side", at[signal], side=wrong, **told)
        elif others and not whole:
            yield f"{name} {signal}", fault("shared_signal", at[signal], other=others[0], **told)
    if not whole and not any(find_other_side(name, owner) for owner in mine.values()):
        signal, owner = next(pair for pair in rest if pair[1] != motor)
        yield f"{name} {signal}", fault(
            "mixed_motors", at[signal], name=name, signal=signal, motor=owner, first=first,
            other=motor,
        )  # fmt: skip
    before = itertools.takewhile(lambda other: other != name, owners)
    twin = next((one for one in before if {*owners[one].values()} == {motor}), None)
    if whole and twin is not None and not other_side:
        line = at.get("voltage", 0)
        yield f"{name} voltage", fault("same_motor", line, other=twin, name=name, motor=motor)


def _find_owners(name: str, signals: Mapping[str, list[Signal]]) -> dict[str, str]:
    """Signal -> its motor. If several fit, one on the side of the name, as the other signals."""
    could = {
        signal: set.intersection(
            *[set(one.owners) for one in many if one.owners or one.follows] or [set()]
        )
        for signal, many in signals.items()
        if signal in NEEDED
    }
    sure = [next(iter(one)) for one in could.values() if len(one) == 1]
    best = {
        signal: {one for one in motors if not find_other_side(name, one)} or motors
        for signal, motors in could.items()
        if motors
    }
    return {
        signal: next((one for one in sure if one in motors), min(motors))
        for signal, motors in best.items()
    }


def _check_all_logged(facts: RoutineFacts, there: Logged, *, demanded: int, points: float) -> None:
    """Raise ``WrongAnswer`` unless every driven motor, or each side of a drivetrain, is logged."""
    driven = [one for one in list_driven(facts) if not one.follows]
    logged = {
        one[0].follows.partition(" ")[2] for signals in there.values() for one in signals.values()
    }
    for pair in SIDES:
        sides = {find_side(one.name, pair) for one in driven} - {""}
        told = {find_side(text, pair) for text in (*there, *logged)} - {""}
        if (
            len(sides) > 1
            and told & sides
            and sides - told
            and turn_independently(facts.name, pair)
        ):
            raise fault("side_missing", side=min(sides - told), earned=round(points / 2, 1))
    if len(there) < min(demanded, len(driven)):
        earned = round(points * len(there) / len(driven), 1)
        raise fault("motors_missing", count=len(there), driven=len(driven), earned=earned)


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
        raise fault("mixed_units", signals=seen)
    if wanted and families and families != {wanted}:
        unit = "Meters" if wanted == "linear" else "Rotations or Radians"
        raise fault("unit_of_mechanism", signals=seen, mechanism=mechanism, unit=unit)
    devices = {one.name: one for one in facts.devices}
    for (name, signal), one in moving.items():
        _check_scale(name, signal, one, devices, scales)
    _check_gearing([devices.get(one.follows.partition(" ")[2]) for one in moving.values()])
    for name in there:
        _check_rate(name, moving.get((name, "position")), moving.get((name, "velocity")))
    for signal in MOVING:
        kept = ((name, one) for (name, kind), one in moving.items() if kind == signal)
        _check_alike([(name, one) for name, one in kept if one.follows.startswith(signal)])
    _check_signs(there)


def _check_scale(
    name: str, signal: str, one: Signal, devices: dict[str, DeviceFacts], scales: dict[str, float]
) -> None:
    """Whether a logged number is in the unit with which it is logged."""
    device = devices.get(one.follows.partition(" ")[2])
    if device is None or not one.scale or not one.follows.startswith(signal):
        return
    sensor = next((d for d in devices.values() if d.turned_by == device.name), None)
    scale = abs(one.scale)
    told: dict[str, Any] = {"name": name, "signal": signal, "motor": device.name}
    if not sensor:
        _check_reported(signal, one, scale * device.gearing, told)
    wanted = scales.get(device.type, scales.get(sensor.type if sensor else "", 0.0))
    if one.family == "linear" and scale > LONGEST and (not sensor or wanted):
        length = f"{scale:.3g}" if scale < LARGE else f"{scale:.0f}"
        raise fault("long_rotation", one.line, length=length, **told)
    if one.family == "linear" and wanted and not _is_close(scale, wanted):
        raise fault("not_as_in_task", one.line, scale=scale, wanted=wanted, **told)


def _check_reported(signal: str, one: Signal, turn: float, told: Mapping[str, Any]) -> None:
    """Whether a logged number is a converted reading of the motor.

    Args:
        signal: ``position`` or ``velocity``.
        one: the signal.
        turn: what is logged for one rotation as the motor reports it, in SI.
        told: for messages: the name in the log, the signal and the motor.
    """
    reports, rpm = REPORTS[signal], "rotations per minute"
    kind = "unconverted_length"
    if one.family == "linear":
        says = f"and the log says {one.unit or 'meters'}"
        taken = {1.0: f"{reports}, {says}"}
        rates = {60.0: f"{rpm}, {says}"}
    elif one.family == "angular":
        kind = "unconverted_angle"
        says = f"and the log says {one.unit or 'an angle'}"
        taken = dict.fromkeys((1.0, 2 * math.pi / 360), f"{reports}, {says}")
        rates = {
            2 * math.pi * 60: f"{rpm}, and the log takes them for {reports}",
            2 * math.pi / 60: f"{reports}, and the log takes them for {rpm}",
        }
    else:
        return
    for factor, what in (taken | (rates if signal == "velocity" else {})).items():
        if _is_close(turn, factor):
            raise fault(kind, one.line, what=what, **told)


def _is_close(one: float, other: float) -> bool:
    return abs(one / other - 1.0) < NEAR


def _check_gearing(logged: Sequence[DeviceFacts | None]) -> None:
    """Raise a fault if only some motors of one type have a gear ratio in their settings."""
    motors = [one for one in logged if one is not None]
    bare = next((one for one in motors if one.gearing == 1.0), None)
    for one in motors:
        if bare and one.gearing != 1.0 and one.type == bare.type:
            raise fault("one_unconfigured", name=bare.name, other=one.name)


def _check_rate(name: str, position: Signal | None, velocity: Signal | None) -> None:
    """Whether the velocity of a motor is the slope of its position."""
    if position is None or velocity is None or not position.scale or not velocity.scale:
        return
    if not velocity.follows.startswith("velocity") or not position.follows.startswith("position"):
        return
    ratio = velocity.scale / position.scale
    if any(_is_close(abs(ratio), one) for one in (1.0, GEARING, 1 / GEARING)) and ratio > 0:
        return  # an absolute sensor turns slower than the motor, by gears that nobody told
    if _is_close(ratio, -1.0):
        raise fault("velocity_sign", velocity.line, name=name, ratio=ratio)
    slips = {**SLIPS, **{1 / factor: said for factor, said in SLIPS.items()}}
    slip = next(
        (said for factor, said in slips.items() if _is_close(abs(ratio), factor)),
        "They are converted differently.",
    )
    raise fault("velocity_unit", velocity.line, name=name, ratio=ratio, slip=slip)


def _check_alike(signals: Sequence[tuple[str, Signal]]) -> None:
    """Whether both sides of a drivetrain count alike."""
    sided = [(name, one) for name, one in signals if find_side(name, SIDES[0]) and one.scale]
    for (name, one), (other, second) in itertools.pairwise(sided):
        ratio = abs((second.scale or 1.0) / (one.scale or 1.0))
        if not _is_close(ratio, 1.0) and one.family == second.family:
            raise fault("sides_count_differently", second.line, other=other, ratio=ratio, name=name)


def _check_signs(there: Logged) -> None:
    """Raise ``WrongAnswer`` unless the signals of each motor agree in their sign.

    How a follower turns is judged where motors are driven, so only its leader is looked at here.
    """
    judged: set[str] = set()
    for name, signals in there.items():
        motion = [one for signal in MOVING for one in signals.get(signal, ())]
        owners = {motor for one in motion for motor in one.owners}
        if len(owners) > 1 and owners & judged:
            continue
        judged |= owners
        signs = {
            signal: math.copysign(1.0, one.scale)
            for signal in NEEDED
            for one in signals.get(signal, ())[:1]
            if one.scale and one.follows.startswith(signal)
        }
        if len(set(signs.values())) > 1:
            odd, *_, other = sorted(signs, key=lambda signal: signs[signal])  # backward comes first
            raise fault("odd_sign", signals[odd][0].line, signal=odd, other=other, name=name)
