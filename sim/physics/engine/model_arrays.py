"""A model as arrays for the engine: gains, parameters and step sizes."""

import inspect
import math

import numpy as np

from sim.core.log import Array
from sim.physics.effects import EFFECTS
from sim.physics.engine.compose import DELAY_HOOKS, HOOKS, make_parameter_slices
from sim.physics.model import Model, Part

COARSEST = 0.0025  # [s] longest step with effects: the error of the midpoint rule is then far
# below a thousandth for time constants above 10 ms
SEARCHED = 0.005  # [s] longest step while a search looks for an effect
LEAST_STEP, LEAST_SEARCHED = 5e-5, 5e-4  # [s] shortest steps: nothing on a robot needs finer ones
STEP_SHARE = 0.12  # [share of the fastest time scale] length of a step
EXACT: Array = np.array([math.inf, math.inf, 0.0, math.inf])  # no limits: the solution is exact
PLACES = make_parameter_slices(EFFECTS)
NEUTRAL: Array = np.array([value for e in EFFECTS.values() for value in e.neutral.values()])
ORDER = {name: place for place, name in enumerate(EFFECTS)}
SLACKS = {
    name: (act, tuple(inspect.signature(act).parameters))
    for name, act in ((one.name, one.hooks.get("backlash_gap")) for one in EFFECTS.values())
    if act is not None
}
DELAYS = frozenset(name for name, one in EFFECTS.items() if set(one.hooks) <= DELAY_HOOKS)


def is_pure_delay(part: Part) -> bool:
    """Whether an effect only delays commands or readings, and changes no force."""
    return part.effect in DELAYS


def make_model_constants(model: Model) -> Array:
    """(8,) constants of the base model, in the order of ``one_body.py``."""
    gains = model.gains
    level = gains.get("kG", 0.0)
    low, high = model.travel or (-math.inf, math.inf)
    return np.array(
        [
            gains["kS"],
            gains["kV"],
            gains["kA"],
            level if model.type == "elevator" else 0.0,
            level if model.type == "arm" else 0.0,
            gains.get("offset_rad", 0.0),
            low,
            high,
        ]
    )


def make_effect_arrays(model: Model) -> tuple[Array, Array]:
    """Flags of the effects in use and of their hooks, and the parameters of all effects.

    Parameters of effects that the model does not have are neutral.
    """
    on = np.zeros(len(EFFECTS) + len(HOOKS) + 1)
    parameters = NEUTRAL.copy()
    for part in model.parts:
        on[ORDER[part.effect]] = 1.0
        for hook in EFFECTS[part.effect].hooks:
            on[len(EFFECTS) + (*HOOKS, "update_memory").index(hook)] = 1.0
        parameters[PLACES[part.effect]] = [part.parameters[n] for n in EFFECTS[part.effect].names]
    return on, parameters


def sum_backlash(model: Model) -> float:
    """[unit] sum of the backlash between motor and load."""
    total = 0.0
    for part in model.parts:
        if part.effect in SLACKS:
            slack, names = SLACKS[part.effect]
            total += float(slack(*(part.parameters[name] for name in names)))
    return total


def find_finest_step(model: Model) -> float:
    """[s] longest step that resolves the fastest of a model's effects."""
    return max(min(COARSEST, STEP_SHARE * _find_shortest_time(model)), LEAST_STEP)


def compute_step_limits(model: Model) -> Array:
    """(4,) step limits: longest [s], longest way [unit], shortest [s], largest change [unit/s]."""
    longest = min(COARSEST, STEP_SHARE * _find_shortest_time(model, places=False))
    way = STEP_SHARE * _find_shortest_length(model)
    return np.array([max(longest, LEAST_STEP), way, LEAST_STEP, math.inf])


def compute_search_step_limits(model: Model) -> Array:
    """(4,) step limits, as in ``compute_step_limits``, while a search looks for an effect.

    Steps are longer, except where the speed changes fast through an effect that depends on speed.
    There even a small integration error exceeds the noise of a good encoder, and any other effect
    with a short time scale, and therefore short steps, would seem to explain it.
    """
    share = 2.0 * STEP_SHARE
    longest = min(SEARCHED, share * _find_shortest_time(model, places=False))
    way, faster = share * _find_shortest_length(model), share * _find_smallest_speed_scale(model)
    return np.array([max(longest, LEAST_SEARCHED), way, LEAST_SEARCHED, faster])


def _find_shortest_time(model: Model, *, places: bool = True) -> float:
    """[s] the shortest time scale of a model.

    ``places`` includes effects that depend on the position, whose steps the way limits as well.
    """
    scales = [model.gains["kA"] / max(model.gains["kV"], 1e-9)]
    for part in model.parts:
        effect = EFFECTS[part.effect]
        if places or effect.shortest_length(part.parameters) == math.inf:
            scales.append(effect.shortest_time(part.parameters, model.gains))
    return min(scales)


def _find_shortest_length(model: Model) -> float:
    """[unit] the shortest length scale of the effects; infinite if none has one."""
    scales = (EFFECTS[part.effect].shortest_length(part.parameters) for part in model.parts)
    return min(scales, default=math.inf)


def _find_smallest_speed_scale(model: Model) -> float:
    """[unit/s] the smallest speed scale of the effects; infinite if none has one."""
    scales = (EFFECTS[part.effect].smallest_speed_scale(part.parameters) for part in model.parts)
    return min(scales, default=math.inf)
