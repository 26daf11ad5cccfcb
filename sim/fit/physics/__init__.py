"""Plausibility checks: gains against motor, gearing, load and gravity.

kV = 12 V / free speed · G/r        that of the motor; drag makes it larger
kA = R·r/(n·Kt·G) · load            that of the load; rotors and wheels make it larger
kG/kA = g                           of an elevator; rotors make it smaller, a cascade larger
"""

import math
from dataclasses import replace

from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.fit.physics.compare import compare_directions, compare_parts
from sim.fit.physics.parts import Parts, fit_in_si
from sim.fit.physics.self_consistency import check_friction, check_gravity, check_timescale
from sim.fit.physics.theory import check_theory, describe_theory
from sim.fit.result import Fit

__all__ = [
    "Parts",
    "check_plausibility",
    "compare_directions",
    "compare_parts",
    "compare_with_theory",
]


def check_plausibility(
    found: Fit, *, parts: Parts | None = None, period: float = 0.02
) -> tuple[Doubt, ...]:
    """Doubts about gains that contradict physics; none if a gain has the wrong sign.

    Args:
        found: the fit, in any unit.
        parts: motor, gearing and load; with None, kV and kA are not checked.
        period: [s] time between two samples of the log.

    Raises:
        BadRequest: a radius although the position is an angle, no radius although it is a length,
            or a period that is not positive.
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
    """A sentence with the theoretical kV and kA; empty without parts or if kV is not positive.

    Args:
        found: the fit, in any unit.
        parts: motor, gearing and load.
    """
    si = fit_in_si(found)
    return (describe_theory(si, parts),) if parts is not None and si.gains["kV"] > 0.0 else ()


def _advise_model_first(doubt: Doubt) -> Doubt:
    """The doubt about a fit with a misfit: a missing effect may be the cause."""
    said = f"{doubt.message.removesuffix('.')}; but the simulation does not match this log. The"
    return replace(doubt, message=f"{said} missing effect may be the cause: find it first.")
