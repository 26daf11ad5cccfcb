"""Small effects that every mechanism has, fitted beside the gains with a prior on their size.

Friction that differs a little between the directions, breakaway friction, air drag and a floor
that is not level are on any robot. Without them in the model, kS, kV and kG take them up: the gains
shift by many times the error that noise alone would leave. Each has a normal prior about zero whose
standard deviation is what a robot in good order has; the data decide how much of it there is, and
what they cannot decide widens the errors of the gains.

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
from sim.fit.search import ROUGHLY, STEPS, TRACKING, fit_open_loop
from sim.physics.effects import EFFECTS
from sim.physics.model import Part

LEAST_KS = 0.05  # [V] of which friction's shares are taken where kS is less
LEAN = 0.05  # [of kS] difference of friction between a direction and their mean
BREAKAWAY = 0.15  # [of kS] friction at rest beyond that in motion
FADES = 0.3  # [of the top speed] over which breakaway friction is gone
DRAG = 0.05  # [V] at the speed of an ordinary step: half a volt at full speed
SLOPE = 0.02  # [V] of a floor, a cable, a spring
FIRST = 0.3  # [of a standard deviation] where a search begins for what cannot be negative
WORTH = 8.0  # [of -2 log L] what they must explain together to be believed
NAMES = ("asymmetric-friction", "stribeck", "drag", "constant-load")
_ABSENT: WeakKeyDictionary[
    Estimate, tuple[PredictionErrorProblem, PredictionErrorProblem, Estimate]
] = WeakKeyDictionary()


def make_everyday_priors(
    problem: PredictionErrorProblem, values: Mapping[str, float]
) -> dict[str, float]:
    """``effect.parameter`` of a small effect -> standard deviation of its prior, in SI.

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

    One Jacobian then tells whether they explain anything, and what they add to the errors.
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
        first: [standard deviations] size of those that cannot be negative; 0 leaves all absent.
    """
    priors = make_everyday_priors(problem, point.values)
    structure = replace(point.structure, effects=(*point.structure.effects, *NAMES))
    values = dict(point.values)
    for name, sd in priors.items():
        known = structure.parameters[name]
        shape = known.neutral > 0.0  # how it looks, not how large it is
        size = (FIRST if shape else first if known.least >= 0.0 else 0.0) * sd
        values[name] = min(max(size, known.least), known.most)
    extended = replace(problem, priors=priors)
    wide = extended.evaluate(structure, values, point.nuisance, point.process_noise)
    if first == 0.0:
        extended.extend_jacobian(wide, problem.compute_jacobian(point, fine=True))
    return extended, wide


def fit_everyday_effects(
    problem: PredictionErrorProblem, point: Estimate
) -> tuple[PredictionErrorProblem, Estimate]:
    """Fit gains and small effects together, if the data ask for the effects.

    Args:
        problem: the measurements.
        point: the best estimate without them.

    Returns:
        Both as they were if the small effects do not explain enough.
    """
    if not predict_step_improvement(*add_absent_effects(problem, point)) > WORTH:
        return problem, point
    size = problem.noise.velocity**2
    extended, begin = add_everyday_effects(problem, point, first=FIRST)
    q = min(point.process_noise, TRACKING * size)
    begin = extended.evaluate(begin.structure, begin.values, begin.nuisance, q)
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
    """The estimate without small effects; its innovations and cost no longer hold."""
    effects = tuple(name for name in point.structure.effects if name not in NAMES)
    return replace(point, structure=replace(point.structure, effects=effects))


def list_everyday_effects(point: Estimate) -> tuple[Part, ...]:
    """The small effects of an estimate, in SI."""
    return tuple(
        Part(name, {one: point.values[f"{name}.{one}"] for one in EFFECTS[name].names})
        for name in NAMES
        if name in point.structure.effects
    )
