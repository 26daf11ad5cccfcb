"""The gains that reconcile reports: with the effects that it found, and without them."""

from collections.abc import Mapping

from sim.core.errors import Refusal
from sim.core.units import Unit, convert_gains
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.run_variation import compute_run_variation_covariance
from sim.fit import Fit, fit
from sim.fit.output_error import compute_gains_with_errors
from sim.fit.result import format_gain_unit
from sim.reconcile.recordings import Recordings
from sim.reconcile.story import ParameterEstimate


def estimate_gains(
    problem: PredictionErrorProblem, point: Estimate, unit: Unit
) -> dict[str, ParameterEstimate]:
    """The gains of an estimate, in the log's unit, with errors that allow for varying runs."""
    spread = compute_run_variation_covariance(problem, point)
    gains, errors = compute_gains_with_errors(point, spread, type=point.structure.type)
    return _describe(
        convert_gains(gains, factor=unit.si), convert_gains(errors, factor=unit.si), unit
    )


def fit_undamaged(recordings: Recordings) -> Fit | None:
    """The result of ``sysid fit``; None if the log is damaged or the fit refuses it."""
    if recordings.damage.excluded.get("log"):
        return None
    try:
        return fit(recordings.log, type=recordings.type).in_units(recordings.unit.name)
    except Refusal:
        return None  # the base model has gains nevertheless


def describe_fit(found: Fit, unit: Unit) -> dict[str, ParameterEstimate]:
    """The gains of a fit, which is in the log's unit."""
    return _describe(found.gains, found.errors, unit)


def _describe(
    gains: Mapping[str, float], errors: Mapping[str, float], unit: Unit
) -> dict[str, ParameterEstimate]:
    return {
        name: ParameterEstimate(value, errors[name], format_gain_unit(name, unit))
        for name, value in gains.items()
    }
