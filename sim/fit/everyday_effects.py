"""Small effects that every mechanism has, fitted together with the gains, with a prior on them.

Every robot has friction that differs a little between the directions, breakaway friction, air drag
and a floor that is not level. A model without them puts them into kS, kV and kG, whose bias is then
many times the standard error from noise alone. Each has a normal prior about zero with the standard
deviation of robots in good order. What the data do not determine makes the errors of the gains
larger.

Source: parameters with a prior, as maximum a posteriori estimates (Ljung, *System Identification*,
section 7.4).
"""

from collections.abc import Mapping
from dataclasses import replace
from weakref import WeakKeyDictionary

from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.optimize import (
    compute_gradient_and_information,
    invert_symmetric,
    levenberg_marquardt,
)
from sim.estimation.random_friction import LEAST_KS
from sim.fit.search import ROUGHLY, STEPS, TRACKING, fit_open_loop
from sim.physics.effects import EFFECTS
from sim.physics.model import Part

LEAN = 0.05  # [of kS] difference of friction between a direction and their mean
BREAKAWAY = 0.15  # [of kS] friction at rest beyond that in motion
FADES = 0.3  # [of the top speed] over which breakaway friction fades
DRAG = 0.05  # [V] drag at the top speed of the log; about half a volt at the free speed
SLOPE = 0.02  # [V] constant load of a floor, a cable, a spring
FIRST = 0.3  # [of a standard deviation] start value of a parameter that cannot be negative
WORTH = 8.0  # [of -2 log L] improvement that parameters must bring: odds of fifty to one
NAMES = ("asymmetric-friction", "stribeck", "drag", "constant-load")
_ABSENT: WeakKeyDictionary[
    Estimate, tuple[PredictionErrorProblem, PredictionErrorProblem, Estimate]
] = WeakKeyDictionary()


def make_everyday_priors(
    problem: PredictionErrorProblem, values: Mapping[str, float]
) -> dict[str, float]:
    """``effect.parameter`` of each small effect -> standard deviation of its prior, in SI.

    Args:
        problem: the measurements.
        values: the gains.
    """
    friction, top = max(values["kS"], LEAST_KS), max(problem.top_speed, 1e-12)
    return {
        "asymmetric-friction.lean": LEAN * friction,
        "stribeck.extra": BREAKAWAY * friction,
        "stribeck.slow": FADES * top,
        "drag.drag": DRAG / top**2,
        "constant-load.load": SLOPE,
    }


def add_absent_effects(
    problem: PredictionErrorProblem, point: Estimate
) -> tuple[PredictionErrorProblem, Estimate]:
    """The estimate in a model with the small effects at size zero; cached per estimate.

    Its Jacobian shows whether they explain anything, and how much they add to the errors.
    """
    found = _ABSENT.get(point)
    if found is None or found[0] is not problem:
        found = _ABSENT[point] = (problem, *add_everyday_effects(problem, point))
    return found[1:]


def add_everyday_effects(
    problem: PredictionErrorProblem, point: Estimate, *, first: float = 0.0
) -> tuple[PredictionErrorProblem, Estimate]:
    """The estimate in a model with the small effects, at size zero or small.

    Args:
        problem: the measurements.
        point: an estimate.
        first: [standard deviations] size of those that cannot be negative; 0 makes all absent.
    """
    priors = make_everyday_priors(problem, point.values)
    structure = replace(point.structure, effects=(*point.structure.effects, *NAMES))
    values = dict(point.values)
    for name, sd in priors.items():
        known = structure.parameters[name]
        shape = known.neutral > 0.0  # a parameter of the effect's shape, not of its size
        size = (FIRST if shape else first if known.least >= 0.0 else 0.0) * sd
        values[name] = min(max(size, known.least), known.most)
    extended = replace(problem, priors=priors)
    wide = extended.change(point, structure=structure, values=values)
    if first == 0.0:
        extended.extend_jacobian(wide, problem.compute_jacobian(point, fine=True))
    return extended, wide


def fit_everyday_effects(
    problem: PredictionErrorProblem, point: Estimate
) -> tuple[PredictionErrorProblem, Estimate]:
    """Fit gains and small effects together, if the effects improve the fit enough.

    Args:
        problem: the measurements.
        point: the best estimate without them.

    Returns:
        The problem with priors and the new estimate, or both unchanged if the small effects do not
        explain enough.
    """
    if not predict_step_improvement(*add_absent_effects(problem, point)) > WORTH:
        return problem, point
    size = problem.noise.velocity**2
    extended, begin = add_everyday_effects(problem, point, first=FIRST)
    q = min(point.process_noise, TRACKING * size)
    begin = extended.change(begin, process_noise=q)
    begin = levenberg_marquardt(extended, begin, steps=STEPS, enough=ROUGHLY)
    found = fit_open_loop(extended, begin)
    return (extended, found) if found.cost < point.cost - WORTH else (problem, point)


def predict_step_improvement(problem: PredictionErrorProblem, point: Estimate) -> float:
    """Decrease of -2 log L by a Newton step of all parameters, to second order.

    Args:
        problem: the measurements.
        point: an estimate whose small effects are absent.
    """
    slope, square = compute_gradient_and_information(problem, point, fine=True)
    return float(slope @ invert_symmetric(square) @ slope)


def remove_everyday_effects(point: Estimate) -> Estimate:
    """The estimate without small effects; its innovations and cost are not updated."""
    effects = tuple(name for name in point.structure.effects if name not in NAMES)
    return replace(point, structure=replace(point.structure, effects=effects))


def list_everyday_effects(point: Estimate) -> tuple[Part, ...]:
    """The small effects of an estimate, in SI."""
    return tuple(
        Part(name, {one: point.values[f"{name}.{one}"] for one in EFFECTS[name].names})
        for name in NAMES
        if name in point.structure.effects
    )
