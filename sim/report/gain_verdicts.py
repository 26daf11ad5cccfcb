"""A sentence about which gains can be used, their errors, and what to record for the others.

kS usable (± 0.01 V), kV usable (± 0.3 %), kA not usable (± 40 %): add a dynamic test.
"""

import math
from collections.abc import Sequence

import numpy as np

from sim.core.log import Log, Run
from sim.core.vocabulary import DIRECTIONS
from sim.fit.result import Fit

SHARES = {"kV": 0.05, "kA": 0.20}
"""Largest relative standard error [1] with which a gain can be used.

A feedforward that is off by a twentieth leaves a twentieth of the speed to feedback; kA matters
only while the speed changes.
"""
VOLTS = 0.05  # [V] largest standard error of a usable kS or kG; carpet and heat change them more
ANGLE = 0.05  # [rad] largest standard error of a usable angle of an arm
READ = "the warnings or the faults say why"  # for a gain that one of them is about
SMALL_STEP = 3.0  # [V] in smaller dynamic tests, friction is large compared with the voltage


def write_gain_verdict(found: Fit, log: Log | None = None) -> str:
    """The sentence about all gains of a fit.

    Args:
        found: the fit, in the unit to show.
        log: what it was fitted to, for advice; None leaves the advice out.
    """
    if any(doubt.grave for doubt in found.doubts):
        return "Do not use these gains: something is wrong."
    usable: list[str] = []
    others: dict[str, list[str]] = {}
    for name in found.gains:
        error = _format_error(name, found.gains[name], found.errors.get(name, math.nan))
        label = "angle" if name == "offset_rad" else name
        if not _is_usable(found, name):
            advice = _advise_test(name, log) if log is not None else ""
            others.setdefault(advice, []).append(f"{label} not usable ({error})")
        elif any(name in doubt.gains for doubt in found.doubts):
            others.setdefault(READ, []).append(f"{label} not usable ({error})")
        else:
            usable.append(f"{label} usable ({error})")
    groups = [
        ", ".join(several) + (f": {what}" if what else "") for what, several in others.items()
    ]
    return "; ".join([", ".join(usable), *groups] if usable else groups) + "."


def judge_gains(found: Fit) -> str:
    """The verdict in a word or two, for a heading."""
    sure = [name for name in found.gains if _is_usable(found, name)]
    doubted = {name for doubt in found.doubts for name in doubt.gains}
    if any(doubt.grave for doubt in found.doubts):
        return "Do not use"
    if doubted >= set(sure):
        return "Not usable"
    if doubted & set(sure):
        return "Check first"
    return "Usable" if len(sure) == len(found.gains) else "Partly usable"


def list_gain_advice(found: Fit, log: Log) -> tuple[str, ...]:
    """What to record so that the gains that are not usable become so; empty if all are.

    Args:
        found: the fit.
        log: what it was fitted to.
    """
    unusable = [name for name in found.gains if not _is_usable(found, name)]
    return tuple(dict.fromkeys(_advise_test(name, log) for name in unusable))


def _is_usable(found: Fit, name: str) -> bool:
    value, error = found.gains[name], found.errors.get(name, math.nan)
    if not math.isfinite(error):
        return False
    if name in SHARES:
        return value > 0.0 and error <= SHARES[name] * value
    return error <= (ANGLE if name == "offset_rad" else VOLTS)


def _format_error(name: str, value: float, error: float) -> str:
    """One standard error: relative for kV and kA, else in V or rad."""
    if not math.isfinite(error):
        return "its error is not known"
    if name in SHARES:
        if value <= 0.0:
            return "not above zero"
        share = error / value
        return "± less than 0.1 %" if share < 0.001 else f"± {_format_two_digits(100.0 * share)} %"  # noqa: PLR2004 - as it says
    unit = "rad" if name == "offset_rad" else "V"
    return f"± less than 0.001 {unit}" if error < 0.001 else f"± {_format_two_digits(error)} {unit}"  # noqa: PLR2004 - the same


def _format_two_digits(number: float) -> str:
    """A number rounded to two digits, as the gains show it, without an exponent: 40, 3.1, 0.015."""
    return f"{float(f'{number:.2g}'):g}"


def _advise_test(name: str, log: Log) -> str:
    """A sentence about the test that makes a gain usable."""
    slow, fast = (
        [run for run in log.runs if run.kind == kind] for kind in ("quasistatic", "dynamic")
    )
    if name == "kA":
        step = _find_largest_voltage(fast)
        if step < SMALL_STEP and fast:
            return f"repeat the dynamic tests with a larger step than {step:.2g} V"
        return "repeat the dynamic tests, and log every loop" if fast else "add a dynamic test"
    missing = [way for way in DIRECTIONS if not any(run.direction == way for run in log.runs)]
    if missing or not slow:
        return f"add the tests in {missing[0]}" if slow else "add a quasistatic test"
    if _find_largest_voltage(slow) < SMALL_STEP:
        return f"let the quasistatic tests run beyond {_find_largest_voltage(slow):.2g} V"
    return "repeat the quasistatic tests with a slower ramp"


def _find_largest_voltage(runs: Sequence[Run]) -> float:
    """[V] the largest voltage of some runs, of either sign; 0 if there are none."""
    return max((float(np.max(np.abs(run.voltage), initial=0.0)) for run in runs), default=0.0)
