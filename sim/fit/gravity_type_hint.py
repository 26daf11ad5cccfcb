"""Suggest another mechanism type where gravity explains most of the residual."""

from sim.core.advice import Action
from sim.core.errors import NotIdentifiable
from sim.core.log import Log
from sim.core.units import find_unit
from sim.estimation.initial_guess import clamp_to_physical, orient_forward
from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.measurements import measure_runs
from sim.estimation.model_structure import ModelStructure
from sim.fit.open_loop_fallback import OpenLoopReplay, replay_open_loop
from sim.fit.search import fit_tracking, make_fit_problem

IMPROVED = 0.33  # [share of the simple model's RMS error] another type must be below it
GRAVITY = ("elevator", "arm")  # types with a force that is constant, or depends on the angle


def hint_gravity_type(
    log: Log,
    problem: PredictionErrorProblem,
    replay: OpenLoopReplay,
    *,
    type: str,  # noqa: A002 - the field's own word
) -> Action | None:
    """A hint where gravity would explain most of the residual of a simple model.

    Args:
        log: any runs.
        problem: its measurements.
        replay: open-loop replay of its best estimate.
        type: the type with which it was fitted.

    Returns:
        The type to try; None if there is none.
    """
    if type != "simple" or not replay.has_misfit:
        return None
    angular = find_unit(log.units).angular
    left = {
        name: _measure_typical_velocity_error(log, problem, name)
        for name in GRAVITY
        if angular or name != "arm"
    }
    best = min(left, key=lambda name: left[name])
    if not left[best] < IMPROVED * replay.rmse:
        return None
    return Action("gravity-type", best)


def _measure_typical_velocity_error(log: Log, problem: PredictionErrorProblem, type: str) -> float:  # noqa: A002 - the field's own word
    """[unit/s] typical velocity error of a quick fit as another type."""
    try:
        log, guess, _ = orient_forward(log, type=type)  # gravity may hide the sign of kV
    except NotIdentifiable:
        return float("inf")
    guess = clamp_to_physical(guess, period=problem.period)
    # with gravity it may lean on a stop, which is not in the model
    other = make_fit_problem(log, measure_runs(log, friction=guess["kS"]))
    return replay_open_loop(other, fit_tracking(other, ModelStructure(type), guess)).rmse
