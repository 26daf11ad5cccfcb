"""Plausibility checks: gains against motor, gearing, load and gravity.

kV = 12 V / free speed · G/r        a motor's own; drag adds, nothing takes away
kA = R·r/(n·Kt·G) · load            rotors and wheels add, nothing takes away
kG/kA = g                           of an elevator; less with rotors, never more
"""

import math
from dataclasses import replace

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.fit.physics.compare import compare_directions, compare_parts, compare_sides
from sim.fit.physics.parts import Parts, fit_in_si
from sim.fit.physics.self_consistency import check_friction, check_gravity, check_timescale
from sim.fit.physics.theory import check_theory, describe_theory
from sim.fit.result import Fit

__all__ = [
    "Parts",
    "check_plausibility",
    "compare_directions",
    "compare_parts",
    "compare_sides",
    "compare_with_theory",
]


def check_plausibility(
    found: Fit, *, parts: Parts | None = None, period: float = 0.02
) -> tuple[Doubt, ...]:
    """Doubts about gains that contradict physics; none if a gain has the wrong sign.

    Args:
        found: the fit, in any unit.
        parts: what it was built from; None leaves kV and kA unchecked.
        period: [s] between two samples of the log.

    Raises:
        BadRequest: a radius for a position that is an angle, none for one that is a length, or a
            period that is no time.
    """
    if not (math.isfinite(period) and period > 0.0):
        raise BadRequest(
            f"a period of {period:g} s", advice="Give the time between two samples of the log."
        )
    si = fit_in_si(found)
    doubts = (
        *check_friction(si),
        *(check_theory(si, parts) if parts is not None else ()),
        *check_gravity(si),
        *check_timescale(si, period),
    )
    strays = any(doubt.code in {"model-strays", "small-misfit"} for doubt in found.doubts)
    return tuple(map(_advise_model_first, doubts)) if strays else doubts


def compare_with_theory(found: Fit, parts: Parts | None) -> tuple[str, ...]:
    """A sentence with the kV and kA of theory; none without parts or with a kV below zero.

    Args:
        found: the fit, in any unit.
        parts: what the mechanism was built from.
    """
    si = fit_in_si(found)
    return (describe_theory(si, parts),) if parts is not None and si.gains["kV"] > 0.0 else ()


def _advise_model_first(doubt: Doubt) -> Doubt:
    """The same doubt about a model that does not hold: the cause may be no part at all."""
    said = f"{doubt.message.removesuffix('.')}; but the simulation does not match this log. The"
    return replace(doubt, message=f"{said} missing effect may be the cause: find it first.")
