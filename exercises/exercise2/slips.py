"""Wrong theoretical kV's, and the mistakes that lead to them."""

import math
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path

from grader.answers.wrong_number import Lookalike, Slips

from .team import Variant

SLIPS = Slips(Path(__file__).with_name("slips.toml"))


def list_lookalikes(variant: Variant) -> tuple[Lookalike, ...]:
    """The results of known slips on a learner's own parts; the measured kV comes first."""
    parts, kv = variant.parts, variant.parts.theoretical_kv
    found = [
        ("measured", variant.measured),
        ("rpm", kv / 60.0),
        ("minutes", kv * 60.0),
        ("no-gears", kv / parts.ratio),
        ("turned-gears", kv / parts.ratio**2),
    ]
    coded = float(variant.told["code"]["ratio"])
    if coded != parts.ratio:
        found.append(("coded-ratio", kv * coded / parts.ratio))
    if parts.diameter:
        radius = "radius-or-motors" if parts.motors == 2 else "radius"
        found += [
            *((radius, kv * times) for times in (0.5, 2.0)),
            *(("around", kv * times) for times in (2 * math.pi, 0.5 / math.pi)),
            ("per-turn", kv * math.pi * parts.diameter),
            ("per-radian", kv * parts.diameter / 2.0),
        ]
    else:
        found += [("radians", kv * times) for times in (2 * math.pi, 0.5 / math.pi)]
        found += [("degrees", kv / 360.0)]
    if parts.motors == 4:
        found += [("motors", kv * times) for times in (0.25, 4.0)]
    return (*SLIPS.list_lookalikes(found), *_list_skipped_steps(variant))


def _list_skipped_steps(variant: Variant) -> Iterator[Lookalike]:
    """Two or more steps from rpm to the unit of kV that were left out."""
    parts = variant.parts
    steps = [(60.0, "60 seconds are a minute"), (parts.ratio, "the gear ratio")]
    if parts.diameter:
        steps.append((1.0 / (math.pi * parts.diameter), "how far one turn of the wheel goes"))
    for count in range(2, len(steps) + 1):
        for skipped in combinations(steps, count):
            missing = " and ".join(name for _, name in skipped)
            code = "skipped-minutes" if steps[0] in skipped else "skipped"
            value = parts.theoretical_kv / math.prod(times for times, _ in skipped)
            yield Lookalike(value, SLIPS.name(code, missing=missing))


def list_rarer_slips(variant: Variant) -> tuple[Lookalike, ...]:
    """The kV of the parts with slips that are less common."""
    kv = variant.parts.theoretical_kv
    found = [("free-speed", 12.0 / kv), ("upside-down", 1.0 / kv)]
    if battery := variant.told.get("noticed", {}).get("battery"):  # a robot of one's own has none
        found.append(("battery", kv * float(battery.strip('"').split()[0]) / 12.0))
    if variant.parts.diameter:
        found += [("no-pi", kv * times) for times in (math.pi, 1 / math.pi)]
    return SLIPS.list_lookalikes(found)
