"""What may have gone wrong with a number on its way from the analyzer into the code."""

from collections.abc import Iterable

from grader.answers.wrong_number import WrongNumber

from .key import FULL, SLOT0, Variant, near

ROUNDED = 0.10  # [share] what rounding to one digit may take away
MINUTE = 60.0
TURN = 6.283185307179586  # [rad]
TEXT = """
integer||Whole numbers divide to a whole number in Java: 1 / 2 is 0
rounded||close, but rounded too much. Keep three digits or more
other||not a gain of this mechanism. They are in given.toml; in practice, in your own fit
other-gain||that is the analyzer's {other}. Copy its {gain}
sign||the size is right, the sign is not
radians|M-UNITS|this value is per radian. {counting}, and one rotation is 2π radians
rotor|M-GEARING|this value is per rotation of the motor's rotor. SensorToMechanismRatio is set, \
so {counting}, and this is {ratio:g} times too small
geared-twice|M-GEARING|this value is multiplied by the gear ratio, but {counting} already
diameter|M-GEARING|twice what it should be: did you take the diameter of the wheel or drum?
volts|M-UNITS|{gain} has no velocity in its unit: volts stay volts, nothing to convert
turned|M-UNITS|converted in the wrong direction: a larger unit needs more volts
twice|M-UNITS|converted twice. In the unit of kA only the seconds are squared, not the length
duty|M-DUTY|wrong by a factor of 12. A feedforward's gains are in volts, whatever the loop outputs
minutes|M-UNITS|wrong by a factor of 60. Did you use minutes instead of seconds?
coded|M-UNITS|this value is per {coded}, but {counting}: convert it
unconverted|M-UNITS|this value is per {given}, as the analyzer shows it. {counting}: the voltage \
will be {factor:.3g} times too {size}
again|M-UNITS|converted twice, in the constant and again here
handed||correct the constant {gain} first
unmodified|M-UNITS|this value is per {given}, as the analyzer shows it. {counting}{also}
output|M-DUTY|the unit is right, the output is not: it is {output}
12-turned|M-DUTY|the output is {output}: did you multiply by 12 instead of dividing?
unit|M-UNITS|this value is still per {given}, but {inner}
kP-turned|M-UNITS|the unit is converted in the wrong direction
kP-other||not the suggested kP. It is in given.toml; in practice, in your own fit
ratio|M-UNITS|The right value is the number of turns of the motor for one turn of the mechanism: \
the gear_ratio of given.toml, not 1 and not its inverse.
no-ratio|M-GEARING|Then the motor controller counts rotations of the motor. Set \
SensorToMechanismRatio to the gear ratio.
level||Without Arm_Cosine the motor controller adds kG at every angle as if the arm were level. \
(Elevator_Static is the default.)
cosine||That is for arms. An elevator weighs the same at every height: use Elevator_Static, or kG.
closed-loop||Then kS follows the sign of the error, and the mechanism may shake around the target. \
Your mechanism follows a velocity: use UseVelocitySign, which is the default.
arm||A Spark adds kG at every angle. An arm's kG goes into kCos.
arm-turns|M-UNITS|kCosRatio converts the encoder's position into rotations of the arm, and the \
Spark takes the cosine of this angle. How many rotations is one of your units?
"""  # of each slip: code, misconception, sentence
SAYS = {
    code: (says, misconception)
    for row in TEXT.strip().splitlines()
    for code, misconception, says in [map(str.strip, row.split("|"))]
}
Ways = list[tuple[str, Iterable[float]]]  # a slip, and what numbers it gives


def name_slip(code: str, gain: str, variant: Variant, other: str = "") -> WrongNumber:
    """A slip in words."""
    says, misconception = SAYS[code]
    output = "a duty cycle, where 1 is 12 V" if variant.duty else "volts"
    words = says.format(
        gain=gain,
        other=other,
        ratio=variant.ratio,
        counting=variant.counting,
        inner=variant.counting.replace("Your", "your"),
        coded=variant.coded_symbol,
        given=variant.symbol(used=False),
        factor=max(variant.times, 1 / variant.times),
        size="large" if variant.times < 1 else "small",
        output=output,
        also=f", and your loop outputs {output}" if variant.duty else "",
    )
    return WrongNumber(code, words, misconception)


def _find_first(value: float, ways: Ways) -> str:
    """The first slip that would give a number; empty if none would."""
    return next((code for code, sizes in ways if any(near(value, size) for size in sizes)), "")


def _list_rotations(gain: str, variant: Variant) -> Ways:
    """Another rotation than the mechanism's, or no rotation, where Slot0Configs counts them."""
    if variant.place != SLOT0 or gain in {"kS", "kG"}:
        return []
    needed = variant.needed(gain)
    return [
        ("radians", [needed / TURN]),
        ("rotor", [needed / variant.ratio]),
        ("geared-twice", [needed * variant.ratio]),
        ("diameter", [2.0 * needed, 2.0 * variant.coded(gain)] if variant.radius else []),
    ]


def _find_known(value: float, gain: str, variant: Variant) -> WrongNumber | None:
    """The slip behind a gain of the feedforward, if its number tells."""
    shown, times = variant.shown[gain], variant.times
    both = (shown, variant.needed(gain))
    code = _find_first(value, _list_rotations(gain, variant))
    for other in variant.gains:
        sizes = (variant.shown[other], variant.needed(other))
        if not code and other != gain and _find_first(value, [("other-gain", sizes)]):
            return name_slip("other-gain", gain, variant, other)
    volts = [("volts", (shown * times, shown / times))]
    scaled = [("turned", [shown / times]), ("twice", [shown * times * times])]
    ways: Ways = [
        ("sign", [-size for size in both]),
        *(volts if gain in {"kS", "kG"} else scaled),
        ("duty", [size * by for size in both for by in (FULL, 1 / FULL)]),
        ("minutes", [size * by for size in both for by in (MINUTE, 1 / MINUTE)]),
    ]
    code = code or _find_first(value, ways)
    return name_slip(code, gain, variant) if code else None


def find_constant_slip(value: float, gain: str, variant: Variant, *, text: str) -> WrongNumber:
    """Why a constant is neither the analyzer's number nor the one the robot needs."""
    if value == 0 and "/" in text:
        return name_slip("integer", gain, variant)
    sizes = (variant.shown[gain], variant.needed(gain))
    rounded = any(near(value, size, share=ROUNDED) for size in sizes)
    found = _find_known(value, gain, variant)
    return found or name_slip("rounded" if rounded else "other", gain, variant)


def find_handed_slip(value: float, gain: str, variant: Variant) -> WrongNumber:
    """Why what a feedforward is given does not fit the robot's unit."""
    shown = variant.shown[gain]
    ways: Ways = [("unconverted", [shown]), ("again", [shown * variant.times**2])]
    if variant.place == SLOT0:
        ways.insert(1, ("coded", [variant.coded(gain)]))
    code = _find_first(value, ways)
    found = None if code else _find_known(value, gain, variant)
    return found or name_slip(code or "handed", gain, variant)


def find_feedback_slip(value: float, variant: Variant, *, text: str = "") -> WrongNumber:
    """Why a kP does not fit the robot's loop."""
    shown, times, needed = variant.shown["kP"], variant.times, variant.needed("kP")
    ways = [
        *_list_rotations("kP", variant),
        ("unmodified", [shown]),
        ("coded", [variant.coded("kP")] if variant.place == SLOT0 else []),
        ("output", {shown * times, shown * times / FULL} - {needed}),
        ("12-turned", [shown * times * FULL]),
        ("unit", [shown / FULL]),
        ("kP-turned", [shown / times, shown / times / FULL]),
    ]
    code = "integer" if value == 0 and "/" in text else _find_first(value, ways)
    if not code and near(value, needed, share=ROUNDED):
        code = "rounded"
    return name_slip(code or "kP-other", "kP", variant)
