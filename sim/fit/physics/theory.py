"""Compare kV and kA with theory, and name the mistake that would explain a difference.

An error in the log's unit changes kV and kA by the same factor, one in the ratio or the radius by
inverse factors.
"""

import math
from collections.abc import Iterator

from sim.core.doubt import Doubt
from sim.core.units import find_unit
from sim.fit.physics.parts import BELOW, HEAVY, SURELY, Parts, check_radius_unit
from sim.fit.result import Fit, format_gain_unit
from sim.physics.motors import MOTORS

DRAG = 1.08  # [share of theory] kV above it has more than ordinary drag
TIGHT = 1.20  # [share of theory] kV above it is hardly explained by drag alone
LIGHT = 0.95  # [share of theory] kA below it is too small: a mass is known to a few percent
NEAR = 0.96, 1.10  # [share of a factor] range that the factor explains, with ordinary drag

FACTORS = (
    (2.0 * math.pi, "rotations read as radians, or a circumference given as the radius"),
    (1.0 / (2.0 * math.pi), "radians read as rotations"),
    (60.0, "a velocity divided by 60 once too often"),
    (1.0 / 60.0, "turns per minute read as turns per second"),
    (60.0 / (2.0 * math.pi), "radians per second converted as if they were rpm"),
    (2.0 * math.pi / 60.0, "rpm read as radians per second"),
    (180.0 / math.pi, "radians read as degrees"),
    (math.pi / 180.0, "degrees read as radians"),
    (360.0, "rotations read as degrees"),
    (1.0 / 360.0, "degrees read as rotations"),
    (2.0, "a diameter given as the radius"),
    (0.5, "a diameter used as the radius in the robot's code"),
    (12.0, "feet read as inches"),
    (1.0 / 12.0, "a duty cycle logged as the voltage, or inches read as feet"),
    (1.0 / 0.3048, "meters read as feet"),
    (0.3048, "feet read as meters"),
    (1.0 / 0.0254, "meters read as inches"),
    (0.0254, "inches read as meters"),
)
"""Ratio of the fitted to the theoretical kV, and the mistake that causes it."""


def check_theory(found: Fit, parts: Parts) -> list[Doubt]:
    """Doubts if kV and kA contradict motor, gearing and load.

    Args:
        found: the fit in SI units.
        parts: motor, gearing and load.

    Raises:
        BadRequest: a radius although the position is an angle, or none although it is a length.
    """
    check_radius_unit(parts, found)
    return [*_check_kv(found, parts), *_check_ka(found, parts)]


def describe_theory(found: Fit, parts: Parts) -> str:
    """A sentence with the theoretical kV and kA, and the fit's shares of them.

    Args:
        found: the fit in SI units, with kV above zero.
        parts: motor, gearing and load.
    """
    per = find_unit(found.log_units)
    size = f"{parts.load or 0.0:g} {'kg·m²' if find_unit(found.units).angular else 'kg'}"
    names = {"kV": "12 V divided by the free speed", "kA": f"{size}, without the rotors"}
    values = {"kV": parts.kv} | ({} if parts.ka is None else {"kA": parts.ka})
    theory = " and ".join(
        f"{name} {value * per.si:.3g} {format_gain_unit(name, per)} ({names[name]})"
        for name, value in values.items()
    )
    shares = " and ".join(
        f"{name} is {found.gains[name] / value:.0%}" for name, value in values.items()
    )
    return (
        f"In theory, {parts.count} × {parts.motor.name} have {theory}. In this log, {shares} of "
        "the theory."
    )


def _check_kv(found: Fit, parts: Parts) -> Iterator[Doubt]:
    """Doubts about kV."""
    kv, error = found.gains["kV"], found.errors["kV"]
    if kv <= 0.0:
        return
    share, unsure = kv / parts.kv, SURELY * error / parts.kv
    said = _describe_difference(found, "kV", parts.kv)
    said += f" from theory (12 V divided by the free speed of {parts.count} × {parts.motor.name})"
    named = [*_explain_ratio(share, parts)]
    if share + unsure < BELOW:
        why = " or ".join(named) or f"a wrong unit, {_suggest_other_parts(kv, parts)}"
        yield Doubt(
            "kv-below-theory",
            f"{said}. That is impossible: no motor turns faster than its free speed. Check "
            f"for {why}. The number of motors does not matter.",
            grave=True,
        )
    elif named and share - unsure > TIGHT:
        yield Doubt("kv-above-theory", f"{said}. Check for {' or '.join(named)}.", grave=True)
    elif share - unsure > TIGHT:
        yield Doubt(
            "kv-above-theory",
            f"{said}. Drag alone does not explain so much. Check the units first, then "
            "whether the log has the applied voltage, then for "
            f"{_suggest_other_parts(kv, parts)}, and at last for a part that rubs.",
        )
    elif share - unsure > DRAG:
        yield Doubt(
            "kv-drag",
            f"{said}. Some friction grows with speed. Check belt tension, gears, grease, and "
            "whether the log has the applied voltage.",
        )


def _describe_difference(found: Fit, gain: str, theory: float) -> str:
    """Half a sentence that compares a gain with its theoretical value, in the log's unit."""
    per = find_unit(found.log_units)
    value, share = found.gains[gain], found.gains[gain] / theory
    far = f"{abs(share - 1.0):.0%} {'above' if share > 1.0 else 'below'}"
    if not 1.0 / TIGHT / TIGHT < share < TIGHT * TIGHT:
        far = f"{share:.3g} times"
    symbol = format_gain_unit(gain, per)
    return f"{gain} = {value * per.si:.3g} {symbol} is {far} the {theory * per.si:.3g} {symbol}"


def _explain_ratio(share: float, parts: Parts) -> list[str]:
    """The mistakes that would explain this share of the theoretical kV, the likeliest first."""
    geared = (
        (
            1.0 / parts.ratio,
            f"a log that counts turns of the motor, without the gear ratio of {parts.ratio:g}",
        ),
        (parts.ratio, f"a gear ratio of {parts.ratio:g} that was applied twice in the log"),
        (parts.ratio**-2, f"a gear ratio of {parts.ratio:g} that is upside down"),
    )
    known = (*FACTORS, *(pair for pair in geared if not 1.0 / TIGHT < pair[0] < TIGHT))
    near = [
        (abs(math.log(share / factor)), factor, why)
        for factor, why in known
        if NEAR[0] < share / factor < NEAR[1]
    ]
    return [f"a factor of {factor:.3g} ({why})" for _, factor, why in sorted(near)[:2]]


def _suggest_other_parts(kv: float, parts: Parts) -> str:
    """The ratio, the radius and the motors that would explain the fitted kV."""
    share = kv / (parts.motor.back_emf * parts.ratio / parts.radius)
    would = [f"a gear ratio of {parts.ratio * share:.3g}"]
    if parts.radius != 1.0:
        would.append(f"a radius of {parts.radius / share * 1000:.3g} mm")
    off = {
        name: share * parts.motor.back_emf / other.back_emf
        for name, other in MOTORS.items()
        if name != parts.motor.name
    }
    others = [name for name in off if BELOW < off[name] < DRAG]
    if others:
        others.sort(key=lambda name: abs(math.log(off[name])))
        would.append(f"another motor ({' or '.join(others[:3])})")
    return " or ".join(would)


def _check_ka(found: Fit, parts: Parts) -> Iterator[Doubt]:
    """Doubts about kA."""
    ka, theory = found.gains["kA"], parts.ka
    if theory is None or ka <= 0.0:
        return
    share, unsure = ka / theory, SURELY * found.errors["kA"] / theory
    size = f"{parts.load:g} {'kg·m²' if find_unit(found.units).angular else 'kg'}"
    motors = f"{parts.count} × {parts.motor.name}"
    difference = _describe_difference(found, "kA", theory)
    said = f"{difference} from theory ({size} on {motors}, without their rotors)"
    where = _place_to_look(found.gains["kV"] / parts.kv, share)
    if _is_kv_plausible(found.gains["kV"] / parts.kv):
        where = f"{where} ({_load_instead(share, parts, size.rpartition(' ')[2])} would fit)"
    if share + unsure < LIGHT:
        yield Doubt(
            "ka-below-theory",
            f"{said}. Rotors can only make kA larger, so the fit or a part that you gave is wrong: "
            f"{where}.",
            grave=True,
        )
    elif share - unsure > HEAVY:
        yield Doubt(
            "ka-above-theory",
            f"{said}. Rotors and wheels add only 3 to 10 %: {where}, or at a late or averaged "
            "velocity.",
        )


def _is_kv_plausible(share: float) -> bool:
    """Whether this share of the theoretical kV is normal."""
    return BELOW < share < DRAG


def _place_to_look(kv: float, ka: float) -> str:
    """Half a sentence of advice, from the shares of the theoretical kV and kA."""
    if _is_kv_plausible(kv):
        return "kV fits, so look at the load, the number of motors and the voltage logged"
    if LIGHT / DRAG < ka / kv < HEAVY / BELOW:
        return (
            "kV is wrong by the same factor, so look at the log's unit, its voltage and the motor"
        )
    if LIGHT * BELOW < ka * kv < HEAVY * DRAG:
        return "kV is wrong by the inverse factor, so look at the ratio and the radius"
    return "first follow the advice about kV, then look at the load and the number of motors"


def _load_instead(share: float, parts: Parts, per: str) -> str:
    """The load, or the number of motors, that would explain a kA."""
    load = f"{(parts.load or 0.0) * share:.3g} {per}"
    count = parts.count / share
    whole = max(round(count), 1)
    if whole != parts.count and NEAR[0] < whole / count < NEAR[1]:
        return f"{load} or {whole} motor{'s' if whole > 1 else ''}"
    return load
