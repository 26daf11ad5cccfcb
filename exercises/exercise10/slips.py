"""What may have gone wrong with a number on its way from the analyzer into the code."""

import re
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from grader.answers.wrong_number import Slips, WrongNumber

from .key import FULL, LENGTHS, SLOT0, Variant, near

ROUNDED = 0.10  # [share] what rounding to one digit may take away
MINUTE = 60.0
TURN = 6.283185307179586  # [rad]
SLIPS = Slips(Path(__file__).with_name("slips.toml"))
Ways = list[tuple[str, Iterable[float]]]  # a slip, and what numbers it gives


def name_slip(code: str, gain: str, variant: Variant, other: str = "") -> WrongNumber:
    """A slip in words."""
    output = "a duty cycle, where 1 is 12 V" if variant.duty else "volts"
    return SLIPS.name(
        code,
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


def _find_first(value: float, ways: Ways) -> str:
    """The first slip that would give a number; empty if none would."""
    return next((code for code, sizes in ways if any(near(value, size) for size in sizes)), "")


def _list_rotations(gain: str, variant: Variant) -> Ways:
    """Another rotation than the mechanism's, or no rotation, where Slot0Configs counts them."""
    if variant.place != SLOT0 or gain in {"kS", "kG"}:
        return []
    needed = variant.needed(gain)
    right = (needed, variant.convert_to_code_unit(gain))
    return [
        ("radians", [needed / TURN]),
        ("rotor", [needed / variant.ratio]),
        ("geared-twice", [needed * variant.ratio]),
        ("diameter", [by * one for one in right for by in (2, 0.5)] if variant.radius else []),
    ]


def _is_mistaken(value: float, gain: str, variant: Variant, text: str) -> bool:
    """Whether a number is converted from another unit of length than the analyzer's."""
    if variant.shown_in not in LENGTHS or re.search(r"\b12\b", text):  # 12 V, or 12 inches?
        return False
    others = {*LENGTHS} - {variant.shown_in, variant.used_in}
    return any(near(value, replace(variant, shown_in=one).needed(gain)) for one in others)


def _find_known_mistake(value: float, gain: str, variant: Variant) -> WrongNumber | None:
    """The known mistake that gives exactly this gain of the feedforward; None if there is none."""
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
    if _is_mistaken(value, gain, variant, text):
        return name_slip("mistaken", gain, variant)
    sizes = (variant.shown[gain], variant.needed(gain))
    rounded = any(near(value, size, share=ROUNDED) for size in sizes)
    found = _find_known_mistake(value, gain, variant)
    return found or name_slip("rounded" if rounded else "other", gain, variant)


def find_handed_slip(value: float, gain: str, variant: Variant) -> WrongNumber:
    """The slip that explains a feedforward argument in another unit than the robot's."""
    shown = variant.shown[gain]
    ways: Ways = [("unconverted", [shown]), ("again", [shown * variant.times**2])]
    if variant.place == SLOT0:
        ways.insert(1, ("coded", [variant.convert_to_code_unit(gain)]))
    code = _find_first(value, ways)
    found = None if code else _find_known_mistake(value, gain, variant)
    return found or name_slip(code or "handed", gain, variant)


def find_feedback_slip(value: float, variant: Variant, *, text: str = "") -> WrongNumber:
    """Why a kP does not fit the robot's loop."""
    shown, times, needed = variant.shown["kP"], variant.times, variant.needed("kP")
    ways = [
        *_list_rotations("kP", variant),
        ("unmodified", [shown]),
        ("coded", [variant.convert_to_code_unit("kP")] if variant.place == SLOT0 else []),
        ("output", {shown * times, shown * times / FULL} - {needed}),
        ("12-turned", [shown * times * FULL]),
        ("unit", [shown / FULL]),
        ("kP-turned", [shown / times, shown / times / FULL]),
    ]
    code = "integer" if value == 0 and "/" in text else _find_first(value, ways)
    if not code and near(value, needed, share=ROUNDED):
        code = "rounded"
    return name_slip(code or "kP-other", "kP", variant)
