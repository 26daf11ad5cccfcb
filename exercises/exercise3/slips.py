"""The slips of exercise 3, and what each would make of a learner's own numbers."""

import math
from collections.abc import Iterator
from pathlib import Path

from grader.answers.number_answer import diagnose_number
from grader.answers.wrong_number import ALIKE, AnswerKey, Lookalike, Scene, Slips, WrongNumber

from .holds import Variant

NEAR = (0.985, 1.0, 1.015)  # [share] a slip is named for who rounds, too
SLIPS = Slips(Path(__file__).with_name("slips.toml"))


def make_key(variant: Variant, *, offset: float) -> AnswerKey:
    """The right numbers, with the results of slips under this offset [deg]."""
    others = {"elevator": "arm", "arm": "elevator"}
    rarer = {
        f"{mine}_{gain}": SLIPS.list_lookalikes(
            [("other", variant.found[f"{other}_{gain}"])], other=other
        )
        for mine, other in others.items()
        for gain in ("kG", "kS")
    }
    true_offset = math.radians(variant.found["arm_offset"])
    cosine = abs(math.cos(true_offset))
    both = variant.found["arm_kG"] * (cosine + abs(math.sin(true_offset)))
    multiplied = variant.found["arm_kG"] * cosine**2
    rarer["arm_kG"] += SLIPS.list_lookalikes(
        [("multiplied", multiplied), ("sum", both)] + [("row", hold.middle) for hold in variant.arm]
    )
    for mine, rows in (("elevator", (variant.elevator,)), ("arm", variant.arm)):
        edges = [("edge", edge) for hold in rows for edge in (hold.lower, hold.upper)]
        middles = [("middle", hold.middle) for hold in rows]
        rarer[f"{mine}_kS"] += SLIPS.list_lookalikes(edges + middles)
    return AnswerKey(
        variant.asked, Scene(lookalikes=dict(_list_lookalikes(variant, offset)), rarer=rarer)
    )


def are_slips_named(variant: Variant) -> bool:
    """Whether every slip earns nothing, and points to one misconception only."""
    key = make_key(variant, offset=variant.found["arm_offset"])
    each = [(name, one) for name, likely in key.scene.lookalikes.items() for one in likely]
    return all(_earns_nothing(name, one, key) for name, one in each) and all(
        {slip.misconception for slip in diagnose_number(name, {name: share * one.value}, key)}
        == {one.slip.misconception}
        for name, one in each
        if one.value
        for share in NEAR
    )


def _earns_nothing(name: str, likely: Lookalike, key: AnswerKey) -> bool:
    asked = key.asked[name]
    full, partial = asked.band.widths(asked.expected)
    allowed = full if likely.slip.code == "largest" else partial
    return abs(likely.value - asked.expected) > allowed


def _list_lookalikes(
    variant: Variant, offset: float
) -> Iterator[tuple[str, tuple[Lookalike, ...]]]:
    """Gain -> the results of known slips on the learner's own numbers [V]."""
    level = next(hold for hold in variant.arm if hold.reading == 0.0)
    found = variant.found
    for name, rows in {"elevator": (variant.elevator,), "arm": variant.arm}.items():
        kg, ks = found[f"{name}_kG"], found[f"{name}_kS"]
        edges = {kg - ks, kg + ks}
        of_kg = [("width", 2.0 * ks), ("both", 2.0 * kg), ("none", 0.0)]
        if name == "arm":
            edges |= {level.lower, level.upper, max(row.upper for row in rows)}
            of_kg += [("as-read", level.middle), ("largest", max(row.middle for row in rows))]
            of_kg += [("degrees", row.middle / math.cos(row.reading + offset)) for row in rows]
            mean = sum(row.middle for row in rows) / len(rows)
            of_kg.append(("mean", mean))
            edges = {edge for edge in edges if abs(edge - mean) > 2 * ALIKE * abs(mean)}
        of_kg += [("edge", edge) for edge in sorted(edges)]
        halves = [ks, *(row.friction for row in rows)]
        of_ks = [("width", 2.0 * half) for half in halves]
        of_ks += [("quarter", half / 2.0) for half in halves]
        of_ks += [("edge", kg - ks), ("simple", kg + ks)]
        yield f"{name}_kG", SLIPS.list_lookalikes(of_kg)
        yield f"{name}_kS", SLIPS.list_lookalikes(of_ks)


def find_offset_slip(value: float, variant: Variant) -> WrongNumber | None:
    """The likely cause of a wrong offset [deg]."""
    if abs(value) == abs(max(variant.arm, key=lambda hold: hold.middle).reading):
        return SLIPS.name("nearest-row")
    right_if_undone = (
        ("sign", -value),
        ("radians", math.degrees(value)),
        ("quotient", math.degrees(math.atan(value))),
        ("rotations", 360.0 * value),
        ("vertical", value + 90.0),
        ("vertical", value - 90.0),
        ("half-turn", value + 180.0),
        ("half-turn", 180.0 - value),
        ("tangent", 90.0 - value),
        ("tangent", -90.0 - value),
    )
    for code, undone in right_if_undone:
        if variant.offset.is_right(wrap_angle(undone)):
            return SLIPS.name(code)
    return None


def wrap_angle(angle: float) -> float:
    """The same angle between -180 and 180 [deg]."""
    return (angle + 180.0) % 360.0 - 180.0
