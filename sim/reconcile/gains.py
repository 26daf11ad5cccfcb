"""The gains that reconcile reports: with the effects that it found, and without them."""

from collections.abc import Mapping
from dataclasses import replace

from sim.core.doubt import Doubt
from sim.core.units import Unit, convert_gains
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.run_variation import compute_run_variation_covariance
from sim.fit import Fit
from sim.fit.fit_doubts import MISFIT
from sim.fit.output_error import compute_gains_with_errors
from sim.fit.result import format_gain_unit
from sim.physics.model import Part
from sim.reconcile.recordings import Recordings
from sim.reconcile.story import ParameterEstimate

STILL_MISSES = (
    "Beside what the fit has already, these effects narrow the gap too little: a simulation with "
    "these gains misses the velocity by more than the sensor noise."
)


def estimate_gains(
    problem: PredictionErrorProblem, point: Estimate, unit: Unit
) -> dict[str, ParameterEstimate]:
    """The gains of an estimate, in the log's unit, with errors that allow for varying runs."""
    spread = compute_run_variation_covariance(problem, point)
    gains, errors = compute_gains_with_errors(point, spread, type=point.structure.type)
    return _make_estimates(
        convert_gains(gains, factor=unit.si), convert_gains(errors, factor=unit.si), unit
    )


def fit_without_effects(
    recordings: Recordings, problem: PredictionErrorProblem, base: Estimate
) -> dict[str, ParameterEstimate]:
    """The gains of ``sysid fit``; those of the base model if the fit refuses or includes damage.

    Args:
        recordings: all logs.
        problem: the measurements.
        base: the best estimate without effects.
    """
    found = recordings.fitted
    if found is None:
        return estimate_gains(problem, base, recordings.unit)
    return _make_estimates(found.gains, found.errors, recordings.unit)


def replace_gains(
    plain: Fit,
    gains: Mapping[str, ParameterEstimate],
    parts: tuple[Part, ...],
    doubts: tuple[Doubt, ...],
    *,
    narrows: bool,
) -> Fit:
    """A fit with the gains, effects and doubts of a model with effects, in the same unit.

    What the model without effects misses says nothing about these gains, unless it is grave; but
    if the effects do not narrow the gap, they miss the log, too. Everything else that is doubted of
    the log still holds.
    """
    missed = not narrows and any(one.code in MISFIT for one in plain.doubts)
    kept = (one for one in plain.doubts if one.grave or one.code not in MISFIT)
    still = (Doubt("small-misfit", STILL_MISSES),) if missed else ()
    return replace(
        plain,
        gains={name: one.value for name, one in gains.items()},
        errors={name: one.error for name, one in gains.items() if one.error is not None},
        parts=parts,
        doubts=(*kept, *still, *doubts),
    )


def _make_estimates(
    gains: Mapping[str, float], errors: Mapping[str, float], unit: Unit
) -> dict[str, ParameterEstimate]:
    return {
        name: ParameterEstimate(value, errors[name], format_gain_unit(name, unit))
        for name, value in gains.items()
    }
