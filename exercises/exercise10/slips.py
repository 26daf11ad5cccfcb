"""What may have gone wrong with a number on its way from the analyzer into the code."""

from grader.wrong_number import WrongNumber

from .key import FULL, SLOT0, Variant, near

ROUNDED = 0.10  # [share] what rounding to one digit may take away
MINUTE = 60.0
TURN = 6.283185307179586  # [rad]


def constant_slip(value: float, gain: str, variant: Variant, *, text: str) -> WrongNumber:
    """Why a constant is neither the analyzer's number nor the one the robot needs."""
    shown = variant.shown[gain]
    return _known(value, gain, variant, text=text) or (
        WrongNumber("rounded", "close, but rounded too much. Keep three digits or more")
        if near(value, shown, share=ROUNDED) or near(value, variant.needed(gain), share=ROUNDED)
        else WrongNumber(
            "other",
            "not a gain of this mechanism. In exercise 10 its gains are in given.toml; in practice "
            "use the gains of your own fit, not those of exercise 10",
        )
    )


INTEGER = WrongNumber("integer", "Whole numbers divide to a whole number in Java: 1 / 2 is 0")
Way = tuple[tuple[float, ...], WrongNumber]  # what a number may be, and what it then comes from


def _known(value: float, gain: str, variant: Variant, *, text: str) -> WrongNumber | None:
    if value == 0:
        return INTEGER if "/" in text else None
    ways = [*_others(gain, variant), *_scaled(gain, variant)]
    return _first(value, [*_in_rotations(gain, variant), *ways])


def _first(value: float, ways: list[Way]) -> WrongNumber | None:
    """The first slip that would give a number."""
    found = (slip for sizes, slip in ways if any(near(value, size) for size in sizes))
    return next(found, None)


def _in_rotations(gain: str, variant: Variant) -> list[Way]:
    """Another rotation than the mechanism's, or no rotation, where Slot0Configs counts them."""
    if variant.place != SLOT0 or gain in {"kS", "kG"}:
        return []
    needed, ratio = variant.needed(gain), variant.ratio
    rotor = (
        "this value is per rotation of the motor's rotor. SensorToMechanismRatio is set, so "
        f"{variant.counting}, and this is {ratio:g} times too small"
    )
    turned = f"this value is multiplied by the gear ratio, but {variant.counting} already"
    radians = f"this value is per radian. {variant.counting}, and one rotation is 2π radians"
    diameter = (
        "twice what it should be: did you use the diameter of the wheel or drum as the radius?"
    )
    ways = [
        ((needed / TURN,), WrongNumber("radians", radians, "M-UNITS")),
        ((needed / ratio,), WrongNumber("rotor", rotor, "M-GEARING")),
        ((needed * ratio,), WrongNumber("geared-twice", turned, "M-GEARING")),
    ]
    if variant.radius:
        ways.append(
            (
                (2.0 * needed, 2.0 * variant.coded(gain)),
                WrongNumber("diameter", diameter, "M-GEARING"),
            )
        )
    return ways


def _others(gain: str, variant: Variant) -> list[Way]:
    """Another gain's number."""
    return [
        (
            (variant.shown[other], variant.needed(other)),
            WrongNumber("other-gain", f"that is the analyzer's {other}. Copy its {gain}"),
        )
        for other in variant.shown
        if other not in {gain, "kP"}
    ]


def _scaled(gain: str, variant: Variant) -> list[Way]:
    """The right number in another unit."""
    shown, needed, times = variant.shown[gain], variant.needed(gain), variant.times
    both = (shown, needed)
    units = f"{gain} has no velocity in its unit: volts stay volts, nothing to convert"
    turned = "converted in the wrong direction: a larger unit needs more volts"
    twice = (
        "converted twice. In the unit of kA only the seconds are squared: convert the length once"
    )
    ways = [
        ((shown / times,), WrongNumber("turned", turned, "M-UNITS")),
        ((shown * times * times,), WrongNumber("twice", twice, "M-UNITS")),
    ]
    if gain in {"kS", "kG"}:
        ways = [((shown * times, shown / times), WrongNumber("volts", units, "M-UNITS"))]
    duty = "wrong by a factor of 12. A feedforward's gains are in volts, whatever the loop outputs"
    minutes = "wrong by a factor of 60. Did you use minutes instead of seconds?"
    return [
        ((-shown, -needed), WrongNumber("sign", "the size is right, the sign is not")),
        *ways,
        (_times(both, FULL), WrongNumber("duty", duty, "M-DUTY")),
        (_times(both, MINUTE), WrongNumber("minutes", minutes, "M-UNITS")),
    ]


def _times(sizes: tuple[float, ...], factor: float) -> tuple[float, ...]:
    return tuple(size * times for size in sizes for times in (factor, 1 / factor))


def handed_slip(value: float, gain: str, variant: Variant) -> WrongNumber:
    """Why what a feedforward is given does not fit the robot's unit."""
    shown, times = variant.shown[gain], variant.times
    given = variant.symbol(used=False)
    if variant.place == SLOT0 and near(value, variant.coded(gain)) and not near(value, shown):
        says = f"this value is per {variant.coded_symbol}, but {variant.counting}: convert it"
        return WrongNumber("coded", says, "M-UNITS")
    if near(value, shown):
        factor = max(times, 1 / times)
        way = "large" if times < 1 else "small"
        says = (
            f"this value is per {given}, as the analyzer shows it. {variant.counting}: the voltage "
            f"will be {factor:.3g} times too {way}"
        )
        return WrongNumber("unconverted", says, "M-UNITS")
    if near(value, shown * times * times):
        says = "converted twice, in the constant and again here"
        return WrongNumber("twice", says, "M-UNITS")
    found = _known(value, gain, variant, text="")
    return found or WrongNumber("other", f"correct the constant {gain} first")


def feedback_slip(value: float, variant: Variant, *, text: str) -> WrongNumber:
    """Why a kP does not fit the robot's loop."""
    shown, times, needed = variant.shown["kP"], variant.times, variant.needed("kP")
    given, code = variant.symbol(used=False), variant.counting
    output = "a duty cycle, where 1 is 12 V" if variant.duty else "volts"
    also = f", and your loop outputs {output}" if variant.duty else ""
    unmodified = f"this value is per {given}, as the analyzer shows it. {code}{also}"
    right, still = "the unit is right, the output is not", f"this value is still per {given}"
    ways = [
        ((shown,), WrongNumber("unmodified", unmodified, "M-UNITS")),
        (
            tuple(size for size in (shown * times, shown * times / FULL) if size != needed),
            WrongNumber("duty", f"{right}: it is {output}", "M-DUTY"),
        ),
        (
            (shown * times * FULL,),
            WrongNumber(
                "duty-turned",
                (f"the output is {output}: did you multiply by 12 instead of dividing?"),
                "M-DUTY",
            ),
        ),
        (
            (shown / FULL,),
            WrongNumber("unit", f"{still}, but {_low(code)}", "M-UNITS"),
        ),
        (
            (shown / times, shown / times / FULL),
            WrongNumber("turned", "the unit is converted in the wrong direction", "M-UNITS"),
        ),
    ]
    ways = [*_in_rotations("kP", variant), *ways]
    found = INTEGER if value == 0 and "/" in text else _first(value, ways)
    if found is None and near(value, needed, share=ROUNDED):
        found = WrongNumber("rounded", "close, but rounded too much. Keep three digits or more")
    return found or WrongNumber(
        "other",
        (
            "not the suggested kP. In exercise 10 it is in given.toml; in practice use the kP of "
            "your own fit"
        ),
    )


def _low(name: str) -> str:
    """A name inside a sentence: ``your code``, but ``Slot0Configs``."""
    return name.replace("Your", "your")
