"""The gains that reconcile reports: with the effects that it found, and without them."""

from collections.abc import Mapping

from sim.core.units import Unit, convert_gains
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.run_variation import compute_run_variation_covariance
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


def _make_estimates(
    gains: Mapping[str, float], errors: Mapping[str, float], unit: Unit
) -> dict[str, ParameterEstimate]:
    return {
        name: ParameterEstimate(value, errors[name], format_gain_unit(name, unit))
        for name, value in gains.items()
    }
