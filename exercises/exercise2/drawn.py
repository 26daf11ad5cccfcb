"""A team for each learner, with one thing that went wrong, or none."""

import numpy as np

from grader.answers.wrong_number import are_distinguishable
from grader.student_data.variant import cache_draws, choose, draw_until, make_student_rng
from sim.physics.motors import MOTORS

from .slips import list_lookalikes
from .team import NEAR, Parts, Variant, find_verdict

LABELS = {
    "krakenX60": "Kraken X60",
    "krakenX44": "Kraken X44",
    "falcon500": "Falcon 500",
    "neo": "NEO",
    "neoVortex": "NEO Vortex",
    "minion": "Minion",
}
BUILT = {  # kind -> motors, how many, ratios, diameters [m]
    "drivetrain": (
        ("krakenX60", "falcon500", "neo", "neoVortex"),
        4,
        (8.14, 7.36, 6.75, 5.9, 5.36),
        (0.1016, 0.0953, 0.0889),
    ),
    "elevator": (("krakenX60", "neo", "neoVortex"), 2, (5.0, 7.5, 9.0, 10.0), (0.0364, 0.0444)),
    "turret": (("krakenX44", "minion", "neo"), 1, (36.0, 45.0, 48.0, 54.0), (0.0,)),
}
CAUSES = ("none", "ratio", "radius", "voltage", "belt")
FREE_DRAG = (0.035, 0.06)  # [share] that grease and seals cost a sound mechanism
BAD_DRAG = (0.26, 0.36)  # [share] of what drags or is dry
TIRED = (10.7, 11.1)  # [V] of a battery that a duty cycle passes on
FRICTION = {"fine": (0.12, 0.38), "watch": (0.55, 0.85), "stop": (1.15, 1.35)}  # [V], [kV·speed]
SPEED = (2.2, 3.4)  # [V] that the typical speed takes
CREEP = (0.7, 1.0)  # [V] that it takes where a mechanism creeps, and less than bad friction does
OFF = (0.08, 0.35)  # [share] that a wrong ratio is off by
CLEAR = 0.7  # [%] from a verdict's bound, whichever theory is taken
APART = 0.045  # [share] two slips, and a slip and the key, are apart
STIFF = "hard to turn by hand, slowly and fast alike; nothing gets hot"  # friction of kS, not of kV
BRAKING = {
    "dragging-belt": "a belt drags over its cover: easy to turn slowly, hard to turn fast",
    "dry-bearing": "a bearing is dry and whistles",
}


@cache_draws
def draw(student: str) -> Variant:
    """A learner's team, always the same one; drawn again until every verdict is clear."""
    return draw_until(
        lambda attempt: _draw_variant(make_student_rng(student, "exercise2", draw=attempt)),
        _is_clear,
    )


def _draw_variant(rng: np.random.Generator) -> Variant | None:
    kind = choose(tuple(BUILT), rng)
    names, count, ratios, diameters = BUILT[kind]
    name = choose(names, rng)
    rpm = round(MOTORS[name].free_speed * 30.0 / 3.141592653589793)
    ratio, diameter = choose(ratios, rng), choose(diameters, rng)
    parts = Parts(LABELS[name], rpm, MOTORS[name].back_emf, count, ratio, diameter)
    cause, flag = choose(CAUSES, rng), choose(tuple(FRICTION), rng)
    if (cause == "radius" and not diameter) or (flag == "stop" and kind == "drivetrain"):
        return None  # a drivetrain never creeps through a match
    factor, words, told = _draw_cause(cause, parts, ratios, rng)
    if flag != "fine" and cause != "belt":
        told["noticed"]["mechanic"] = f'"{STIFF}"'
    measured = float(f"{parts.exact * factor:.4g}")
    volts = float(rng.uniform(*(CREEP if flag == "stop" else SPEED)))
    friction = float(rng.uniform(*FRICTION[flag])) * (volts if flag == "stop" else 1.0)
    speed = float(f"{volts / measured:.2g}")
    return Variant(kind, parts, measured, round(friction, 2), speed, words, told)


def _draw_cause(
    cause: str, parts: Parts, ratios: tuple[float, ...], rng: np.random.Generator
) -> tuple[float, tuple[str, ...], dict[str, dict[str, str]]]:
    """A random error of kV, the words for its cause, and the signs of it that the team sees."""
    factor, words = 1.0 + float(rng.uniform(*FREE_DRAG)), ()
    ratio, radius, battery = parts.ratio, parts.diameter / 2.0, float(rng.uniform(12.2, 12.6))
    drive, logged = "motor.setVoltage(volts)", "the applied volts"
    mechanic = "everything turns by hand as easily as when it was new, and stays cool"
    if cause == "ratio":
        ratio = choose(tuple(one for one in ratios if one != parts.ratio), rng)
        factor, words = factor * ratio / parts.ratio, ("gear-ratio",)
    elif cause == "radius":
        times = choose((0.5, 2.0), rng)
        radius *= times
        factor, words = factor / times, ("wheel-size",)
    elif cause == "voltage":
        battery = round(float(rng.uniform(*TIRED)), 1)
        drive, logged = "motor.set(volts / 12)", "the commanded volts"
        factor, words = factor * 12.0 / battery, ("logged-voltage",)
    elif cause == "belt":
        part = choose(tuple(BRAKING), rng)
        factor, words = 1.0 + float(rng.uniform(*BAD_DRAG)), (part,)
        mechanic = f"{BRAKING[part]}; it is too hot to touch after a test"
    code = {"ratio": f"{ratio:g}"}
    if parts.diameter:
        code["radius"] = f"{radius:.5g}  # [m]"
    heavier = float(rng.uniform(2.0, 5.0))
    noticed = {
        "battery": f'"{battery:.1f} V, all through the tests"',
        "mechanic": f'"{mechanic}"',
        "changed": f'"{heavier:.1f} kg more on it than last week"',
    }
    code |= {"drive": f'"{drive}"', "logged_voltage": f'"{logged}"'}
    return factor, words, {"code": code, "noticed": noticed}


def _is_clear(variant: Variant) -> bool:
    """Whether the verdict is the same by either theory, and slips are told apart."""
    ways = {
        find_verdict(variant.compute_percent_above(theory) + off)
        for theory in variant.theories
        for off in (-CLEAR, CLEAR)
    }
    low, high = variant.compute_percent_above(variant.parts.theoretical_kv), OFF[1] * 100.0
    if "gear-ratio" in variant.planted and not OFF[0] * 100.0 < abs(low) < high:
        return False
    found = list_lookalikes(variant)[1:]
    kv, near = variant.parts.theoretical_kv, 2.0 * NEAR.full
    return (
        len(ways) == 1
        and abs(low) > 2.5
        and all(abs(one.value / kv - 1.0) >= near for one in found)
        and are_distinguishable(found, apart=APART, by=lambda slip: slip.misconception)
    )
