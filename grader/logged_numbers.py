"""Whether logged numbers are what their names and units say, judged by the device behind them.

The facts come from ``grader.robotcode.readings``. What reading cannot tell is left alone here.
"""

import itertools
import math
import re
from collections.abc import Iterator, Sequence

from grader.check import WrongAnswer
from grader.robotcode.facts import LoggedSignal, RoutineFacts
from grader.robotcode.readings import PULSE_COUNT
from grader.sysid_routine_checks import quote_code

SIDES = (("left", "right"), ("front", "back"), ("front", "rear"), ("top", "bottom"))
MOVING = ("position", "velocity")
UNITS_OF = {
    "rotation": "rotations",
    "rotation per second": "rotations per second",
    "rpm": "rotations per minute",
    "pulse": "pulses",
}
DIVIDES_BY_ZERO = re.compile(r"/\s*0(?:\.0*)?(?![\w.])")
SIZE = re.compile(r"gear|ratio|diameter|radius|circumference", re.IGNORECASE)
GEARS = re.compile(r"gear|ratio|reduction", re.IGNORECASE)
WHEEL = re.compile(r"diameter|radius", re.IGNORECASE)
ONE_TURN = re.compile(r"per_?(turn|rot|rev)|circumference|conversion|factor", re.IGNORECASE)
CLOSE = 1e-6  # relative
LONGEST = 2.0  # [m] no wheel or drum lays so much behind it in one rotation of its motor
LARGE = 1000.0  # [m] from here on a length is written without decimals
SHARE = 1 / 6  # of the log's points: one wrong signal


def check_devices(facts: RoutineFacts, *, points: float) -> None:
    """Raise ``WrongAnswer`` unless each motor's entries come from its own devices.

    Args:
        facts: what the code says.
        points: of the check, of which each wrong signal loses its share.

    Raises:
        WrongAnswer: one does not.
    """
    faults = [
        *_find_wrong_quantity(facts.logged),
        *_find_wrong_side(facts.logged),
        *_find_shared_device(facts),
    ]
    if faults:
        signals = {signal for signal, _, _ in faults}
        lost = sum(1 / 2 if name.endswith("voltage") else SHARE for name in signals)
        _, seen, hint = faults[0]
        raise WrongAnswer(seen, hint=hint, earned=max(round(points * (1.0 - lost), 1), 0.0))


Fault = tuple[str, str, str]  # which signal of which motor, what was seen, and the advice


def _find_wrong_quantity(signals: Sequence[LoggedSignal]) -> Iterator[Fault]:
    for one in signals:
        moving = one.signal in MOVING and one.quantity in {*MOVING, "acceleration", "current"}
        wrong = moving or (one.signal == "voltage" and one.quantity in {*MOVING, "current"})
        if wrong and one.quantity != one.signal:
            yield (
                f"{one.motor} {one.signal}",
                (
                    f"{quote_code(one)}: the {one.signal} of {one.motor} is the {one.quantity} of "
                    f"{one.device}"
                ),
                f"Log the {one.signal} there: each value has its own method.",
            )


def _find_wrong_side(signals: Sequence[LoggedSignal]) -> Iterator[Fault]:
    for one in signals:
        for pair in SIDES:
            named, asked = _find_side(one.motor, pair), _find_side(one.device, pair)
            if named and asked and named != asked:
                yield (
                    f"{one.motor} {one.signal}",
                    f"{quote_code(one)}: {one.motor} gets the {one.signal} of {one.device}",
                    (
                        "Did you copy a line and forget to change it? Under the name "
                        f"{one.motor}, log the values of the {named} motor."
                    ),
                )


def _find_side(name: str, pair: tuple[str, str]) -> str:
    """The side that a name tells, of a pair; empty if it tells none or both."""
    words = [word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)]
    found = [side for side in pair if side in words]
    return found[0] if len(found) == 1 else ""


def _find_shared_device(facts: RoutineFacts) -> Iterator[Fault]:
    """Two motors of the log with one device, though each has a device of its own."""
    names = list(dict.fromkeys(one.motor for one in facts.logged if one.motor))
    types = [type_ for _, type_ in facts.devices]
    for signal in ("voltage", *MOVING):
        first: dict[str, LoggedSignal] = {}
        for one in facts.logged:
            if one.signal != signal or not one.device or not one.motor:
                continue
            before = first.setdefault(one.device, one)
            kind = "RelativeEncoder" if signal != "voltage" else ""
            enough = types.count(one.type) >= len(names) or one.type == kind
            if before.motor != one.motor and len(names) > 1 and enough:
                yield (
                    f"{one.motor} {signal}",
                    (
                        f"{quote_code(one)}: "
                        f"{one.motor} gets the {signal} of {one.device}, and so does "
                        f"{before.motor}"
                    ),
                    (
                        f"Did you copy a line and forget to change it? Log for {one.motor} the "
                        "values of its own motor and its own encoder."
                    ),
                )
    yield from _find_mixed_devices(facts)


def _find_mixed_devices(facts: RoutineFacts) -> Iterator[Fault]:
    """The position of one device with the velocity of another of its kind."""
    for name in dict.fromkeys(one.motor for one in facts.logged):
        there = {one.signal: one for one in facts.logged if one.motor == name}
        pairs = [("position", "velocity"), ("voltage", "position")]
        for earlier, later in pairs:
            one, other = there.get(earlier), there.get(later)
            if one is None or other is None or not one.device or not other.device:
                continue
            if one.type == other.type and one.device != other.device:
                yield (
                    f"{name} {later}",
                    (
                        f"{quote_code(other)}: the {later} of {name} comes from {other.device}, "
                        f"its {earlier} from {one.device}"
                    ),
                    "All three signals of a motor must come from the same side.",
                )


def check_all_logged(facts: RoutineFacts, *, demanded: int, points: float) -> None:
    """Raise ``WrongAnswer`` unless every driven motor, or each side of a drivetrain, is logged.

    Args:
        facts: what the code says.
        demanded: how many motors the task itself asks for; 0 if it does not say.
        points: of the check, of which a missing motor loses its share.

    Raises:
        WrongAnswer: one is missing.
    """
    names = list(dict.fromkeys(one.motor for one in facts.logged))
    driven = list(dict.fromkeys(call.motor for call in facts.drive))
    for pair in SIDES:
        sides = {_find_side(name, pair) for name in driven} - {""}
        logged = {
            _find_side(text, pair) for one in facts.logged for text in (one.motor, one.device)
        }
        if (
            len(sides) > 1
            and logged & sides
            and sides - logged
            and _turn_independently(facts, pair)
        ):
            missing = min(sides - logged)
            _raise_missing(f"no {missing} motor in the log", 1 / 2, points)
    if len(names) < min(demanded, len(driven)):
        seen = f"{len(names)} of {len(driven)} motors in the log"
        _raise_missing(seen, len(names) / len(driven), points)


def _raise_missing(seen: str, share: float, points: float) -> None:
    raise WrongAnswer(
        seen,
        hint="The Mechanism drives two sides, and each has its own friction. Log every motor, each "
        "under its own name.",
        earned=round(points * share, 1),
    )


def _turn_independently(facts: RoutineFacts, pair: tuple[str, str]) -> bool:
    """Whether the motors of a class turn on their own, and not one shaft together."""
    coupled = r"elevator|lift|climb|telescop|slide|arm|wrist|pivot|hood|turret"
    one_shaft = coupled if pair == ("top", "bottom") else rf"{coupled}|shooter|flywheel"
    return not re.search(one_shaft, facts.class_name, re.IGNORECASE)


def check_signs(facts: RoutineFacts, *, points: float, mirrored: bool) -> str | None:
    """Raise ``WrongAnswer`` if a motor gets the voltage with a wrong sign.

    Args:
        facts: what the code says.
        points: of the check.
        mirrored: whether a motor may get the test's voltage with the other sign: on a robot where
            it is mounted the other way round.

    Returns:
        A note on a motor that gets the other sign and may.

    Raises:
        WrongAnswer: a sign cannot be right.
    """
    flipped = [call for call in facts.drive if call.negative]
    for call in flipped:
        at = quote_code(call)
        turned = call.motor in facts.inverted
        if turned:
            hint = (
                "The code inverts this motor as well, and two inversions cancel. Leave one of "
                "them out."
            )
        elif len(flipped) == len(facts.drive):
            hint = "Then a forward test runs backward. Send the voltage without changing its sign."
        else:
            hint = (
                "Nothing here says that this motor is mounted the other way round. If it is, "
                "invert it where it is made, and send both sides the same voltage."
            )
        if turned or not mirrored:
            raise WrongAnswer(
                f"{at}: the sign of the voltage is changed", hint=hint, earned=points / 2
            )
    if flipped:
        return (
            f"{flipped[0].motor} gets the other sign. That is right only if it is mounted the "
            "other way round. To invert it where it is made is safer."
        )
    return None


def check_logged_signs(signals: Sequence[LoggedSignal]) -> None:
    """Raise ``WrongAnswer`` unless the signals of each motor agree in their sign.

    Raises:
        WrongAnswer: one signal is inverted and another is not.
    """
    for one in signals:
        if one.unsigned and one.signal in {*MOVING, "voltage"}:
            raise WrongAnswer(
                f"{quote_code(one)}: the {one.signal} of {one.motor} loses its sign",
                hint="Half of the tests run backward. Log the number with its sign.",
            )
    for name in dict.fromkeys(one.motor for one in signals):
        found = [
            (one, one.scale > 0)
            for one in signals
            if one.motor == name and one.signal in {*MOVING, "voltage"} and one.scale
        ]
        up = [one for one, positive in found if positive]
        down = [one for one, positive in found if not positive]
        if up and down:
            odd, rest = (down, up) if len(down) <= len(up) else (up, down)
            raise WrongAnswer(
                f"{quote_code(odd[0])}: "
                f"the {odd[0].signal} of {name} has a sign of its own, unlike its "
                f"{rest[0].signal}",
                hint="A positive voltage must give a positive velocity and a growing position. "
                "Log all three with the same sign.",
                misconception="",
            )


def check_sources(signals: Sequence[LoggedSignal], *, geared: frozenset[str]) -> None:
    """Raise ``WrongAnswer`` unless each number is in the unit with which it is logged.

    Args:
        signals: the positions and velocities that are recorded.
        geared: the motors that are set to report rotations of the mechanism.

    Raises:
        WrongAnswer: one is not.
    """
    for one in signals:
        if DIVIDES_BY_ZERO.search(one.text):
            raise WrongAnswer(
                f"{quote_code(one)}: a number divided by 0",
                hint="The result is infinite. Divide by the gear ratio, or not at all.",
                misconception="M-UNITS",
            )
        if geared and one.native.startswith("rotation") and not geared & {one.device, "*"}:
            raise WrongAnswer(
                f"{quote_code(one)}: "
                f"{one.device} gets no configuration, so it reports rotations of the "
                f"motor; {min(geared)} reports those of the mechanism",
                hint="Apply the configuration with the gear ratio to every motor.",
                misconception="M-UNITS",
            )
        hint = _describe_unit_slip(one)
        if hint:
            raise WrongAnswer(
                f"{quote_code(one)}: {one.device} reports {UNITS_OF[one.native]}, and the log says "
                f"{_cite(one)}",
                hint=hint,
                misconception="M-UNITS",
            )
    for name in dict.fromkeys(one.motor for one in signals):
        _check_rate([one for one in signals if one.motor == name])
    for signal in MOVING:
        _check_alike([one for one in signals if one.signal == signal])


def _describe_unit_slip(one: LoggedSignal) -> str:
    """What to say of a number whose unit is not the wrapper's; empty if it may be."""
    if one.native not in UNITS_OF or one.scale is None:
        return ""
    per_second = abs(one.scale) * (60.0 if one.native == "rpm" else 1.0)
    bare = math.isclose(abs(one.scale), 1.0, rel_tol=CLOSE)
    if one.family != "linear":
        return _describe_angular_slip(one, per_second, bare=bare)
    hint = ""
    if one.type == PULSE_COUNT:
        hint = "Ask getDistance() and getRate(): they know the distance of a pulse."
    elif one.native == "pulse" and bare:
        hint = "Until setDistancePerPulse() is called, an encoder counts pulses. Set it first."
    elif bare or math.isclose(per_second, 1.0, rel_tol=CLOSE):
        hint = (
            "The unit's name around a number converts nothing. Multiply by the meters of one "
            "rotation: the wheel's circumference over the gear ratio."
        )
    elif one.native != "pulse" and per_second > LONGEST:
        hint = (
            f"One rotation would be {_meters(per_second)} m. Multiply by the meters of one "
            "rotation, and by nothing else; do not divide by them."
        )
    return hint


def _meters(length: float) -> str:
    """Three digits, and no powers of ten: a learner reads this."""
    return f"{length:.3g}" if length < LARGE else f"{length:.0f}"


def _describe_angular_slip(one: LoggedSignal, per_second: float, *, bare: bool) -> str:
    unit = one.unit.lower()
    plain = "The unit's name around a number converts nothing. "
    if "radian" in unit or "degree" in unit:
        if bare or math.isclose(per_second, 1.0, rel_tol=CLOSE):
            return f"{plain}Name the unit it is in, Rotations, and a measure converts itself."
        return ""
    minutes = "minute" in unit or unit == "rpm"
    if one.native == "rpm" and bare and not minutes:
        return f"{plain}A minute has 60 seconds: divide by 60, or name the unit RPM."
    if one.native == "rotation per second" and bare and minutes:
        return f"{plain}It is per second: name the unit RotationsPerSecond."
    return ""


def _check_rate(signals: Sequence[LoggedSignal]) -> None:
    """Whether the velocity of a motor is the slope of its position."""
    there = {one.signal: one for one in signals}
    position, velocity = there.get("position"), there.get("velocity")
    if position is None or velocity is None or not position.scale or not velocity.scale:
        return
    same = (position.device, position.type) == (velocity.device, velocity.type)
    if not same or not position.native or not velocity.native or not velocity.family:
        return
    if velocity.family == "angular" and ("minute" in velocity.unit.lower() or not position.unit):
        return
    ratio = velocity.scale * (60.0 if velocity.native == "rpm" else 1.0) / position.scale
    if math.isclose(ratio, 1.0, rel_tol=1e-3):
        return
    seen = (
        f"{quote_code(velocity)}: the velocity of {velocity.motor} is {ratio:.4g} times the slope "
        "of "
    )
    if math.isclose(ratio, -1.0, rel_tol=1e-3):
        hint = "One of the two has the wrong sign. Log both with the same sign."
        raise WrongAnswer(f"{seen}its position", hint=hint)
    hint = "Convert position and velocity by the same factor, and the velocity to seconds."
    if math.isclose(abs(ratio), 60.0, rel_tol=1e-3):
        hint = f"{velocity.device} reports rotations per minute. Divide the velocity by 60."
    raise WrongAnswer(f"{seen}its position", hint=hint, misconception="M-UNITS")


def _check_alike(signals: Sequence[LoggedSignal]) -> None:
    """Whether both sides of a drivetrain count alike."""
    sided = [one for one in signals if _find_side(one.motor, SIDES[0]) and one.scale and one.native]
    for one, other in itertools.pairwise(sided):
        if one.type != other.type or one.native != other.native or one.unit != other.unit:
            continue
        ratio = abs((other.scale or 1.0) / (one.scale or 1.0))
        if not math.isclose(ratio, 1.0, rel_tol=1e-3):
            raise WrongAnswer(
                f"{quote_code(other)}: "
                f"the {other.signal} of {other.motor} counts {ratio:.4g} times what "
                f"that of {one.motor} counts",
                hint="Both sides have the same wheels and gears. Convert both in the same way.",
                misconception="M-UNITS",
            )


def check_constants(facts: RoutineFacts, given: dict[str, float]) -> None:
    """Raise ``WrongAnswer`` unless the task's numbers are unchanged and used.

    Args:
        facts: what the code says.
        given: the task's own constants, name and value.

    Raises:
        WrongAnswer: a number was changed, or is not used.
    """
    there = dict(facts.constants)
    for name, value in given.items():
        if name in there and not math.isclose(there[name], value, rel_tol=1e-3):
            raise WrongAnswer(
                f"{name} is {there[name]:.4g}, and the task's own file says {value:.4g}",
                hint="It belongs to the wheels and gears of this drivetrain. Leave it as it was.",
                misconception="M-UNITS",
            )
        moving = [one for one in facts.logged if one.signal in MOVING and name in there]
        for one in moving:
            per_second = 60.0 if one.native == "rpm" else 1.0
            known = one.native in {"rotation", "rotation per second", "set"} and one.scale
            if not known or one.unit not in {"", "Meters", "MetersPerSecond"}:
                continue
            scale = abs(one.scale or 0.0) * per_second
            if not math.isclose(scale, value, rel_tol=1e-3):
                raise WrongAnswer(
                    f"{quote_code(one)}: "
                    f"{one.device}'s number is multiplied with {scale:.4g} in all, and "
                    f"{name} is {value:.4g}",
                    hint=f"Multiply by {name} exactly once.",
                    misconception="M-UNITS",
                )


def check_circumference(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` unless one turn is π diameters of the wheel, or 2π radii.

    Raises:
        WrongAnswer: it is one of the two mistaken for the other, or made without π.
    """
    gears = [value for name, value in facts.constants if GEARS.search(name) and value]
    wheels = [one for one in facts.constants if WHEEL.search(one[0]) and one[1] > 0.0]
    for (name, way), (wheel, size) in itertools.product(facts.constants, wheels):
        if not ONE_TURN.search(name) or name == wheel:
            continue
        turns = [abs(way) / size * by for by in (1.0, *gears, *(1.0 / one for one in gears))]
        radius = "radi" in wheel.lower()
        right = 2.0 * math.pi if radius else math.pi
        slips = (1.0, 2.0, math.pi / 2.0, math.pi, 2.0 * math.pi, 4.0 * math.pi)
        if not _is_among(turns, (right,)) and _is_among(turns, slips):
            formula = f"2π times {wheel}" if radius else f"π times {wheel}"
            raise WrongAnswer(
                f"{name} is {way:.4g}, and {wheel} {size:.4g}",
                hint=(
                    f"In one turn a wheel rolls its circumference, {formula}; divide it by the "
                    "gear ratio."
                ),
                misconception="M-UNITS",
            )


def _is_among(found: Sequence[float], expected: Sequence[float]) -> bool:
    pairs = itertools.product(found, expected)
    return any(math.isclose(one, other, rel_tol=CLOSE) for one, other in pairs)


def check_numbers(facts: RoutineFacts) -> None:
    """Raise ``WrongAnswer`` if two devices share a port or CAN ID, or a gear or wheel has no size.

    Raises:
        WrongAnswer: two are, or one has none.
    """
    for name, value in facts.constants:
        if SIZE.search(name) and not value > 0.0:
            raise WrongAnswer(
                f"{name} is {value:g}",
                hint="No gear ratio and no wheel is zero or less. Write what is built in.",
                misconception="M-UNITS",
            )
    for name, number in facts.impossible_numbers:
        raise WrongAnswer(
            f"{name} is made with {number:g}",
            hint="That cannot be a port or a CAN ID. Check the wiring.",
        )
    for one, other in facts.same_numbers:
        raise WrongAnswer(
            f"{one} and {other} are made with the same number",
            hint=(
                "Two devices cannot share a port or a CAN ID. Did you copy a line and forget "
                "to change it?"
            ),
        )


def _cite(one: LoggedSignal) -> str:
    if one.unit:
        return one.unit
    if one.family == "linear":
        return "meters" if one.signal == "position" else "meters per second"
    return "rotations" if one.signal == "position" else "rotations per second"
