"""Fit kS, kV, kA and kG to logs.

    from sim.fit import fit
    fit(sim.read("drive.wpilog")).gains

Method ``output-error``, the default, compares the log with a simulation. It takes any runs,
includes static friction and delayed or averaged velocities, and gives realistic standard errors.
Method ``sysid`` is the recipe of WPILib SysId 2026.2.2 to the last digit. Where SysId gives NaN or
nonsense, it refuses or warns, and says why.
"""

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest, refuse_unknown
from sim.core.log import Log
from sim.core.vocabulary import METHODS, TYPES
from sim.fit.result import Fit

__all__ = ["Fit", "fit"]


def fit(log: Log, *, type: str = "", method: str = METHODS[0], median: int = 1) -> Fit:  # noqa: A002
    """Fit kS, kV, kA (and kG) to a log.

    Args:
        log: the runs.
        type: ``simple``, ``elevator`` or ``arm``; empty takes the type in the log, else ``simple``.
        method: ``output-error`` or ``sysid``.
        median: [samples] window of a median filter on the velocity; 1 is none.

    Returns:
        Gains with their errors, in SI; ``Fit.in_units`` converts them.

    Raises:
        BadRequest: an unknown type or method, a median filter with ``output-error``, or an arm
            whose position is not an angle.
        NotIdentifiable: the log does not determine these gains; the message says which test would.

    Examples:
        >>> import numpy as np
        >>> from sim.bench.mechanisms import MECHANISMS
        >>> from sim.bench.routine import Routine
        >>> from sim.bench.simulate import simulate
        >>> log = simulate(MECHANISMS["drivetrain"], Routine(), rng=np.random.default_rng(0))
        >>> found = fit(log)
        >>> round(found.gains["kV"], 2)  # [V·s/m]
        2.52
    """
    chosen = type or log.type or "simple"
    refuse_unknown("type", chosen, TYPES)
    refuse_unknown("method", method, METHODS)
    if not type and chosen != "simple" and chosen in log.mechanism.lower():
        log = log.add_doubts(_type_from_name(log))
    if method == "sysid":
        from sim.fit.wpilib_sysid import fit_wpilib_sysid  # noqa: PLC0415 - one method does not wait for the other

        return fit_wpilib_sysid(log, type=chosen, median=median)
    if median != 1:
        raise BadRequest(
            f"method {method} has no median filter, but a window of {median} samples was asked for",
            advice=(
                "The median filter belongs to SysId's method: add --method sysid. Our method "
                "needs no filter."
            ),
        )
    from sim.fit.output_error import fit_output_error  # noqa: PLC0415 - the same

    return fit_output_error(log, type=chosen)


def _type_from_name(log: Log) -> Doubt:
    """A warning that the type was taken from the name of the mechanism."""
    return Doubt(
        "type-from-name",
        f"Fitted with the type {log.type}, because the log's mechanism is named {log.mechanism!r}.",
        action=Action("other-type"),
    )
