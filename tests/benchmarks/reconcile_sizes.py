"""How large what is hidden is: sizes and shapes drawn anew for every case.

The catalogue's own examples are where it starts; a solver that had learned them by heart would gain
little, since sizes, signs, phases, places and shares are drawn.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from reconcile_plan import ELEVATORS, FAULTS, GIVEN_AS_SIMPLE, SUBTLE, Case

from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.physics.battery import Battery
from sim.physics.effect import Scale
from sim.physics.effects import find_effect as find
from sim.physics.model import Part

ORDINARY = (0.75, 1.35)  # [1] sizes of what is realistic
A_THIRD = (0.25, 0.40)  # [1] sizes of what is subtle
SLOWEST_STEP = 3.5  # [V] about the smallest step of a case: what is hidden shows in all three logs

STIFF = Battery(resistance=0.0)  # the voltage in the log is the motor's in between samples, too
UNLIMITED = 1e4  # [A] for the same reason: limits are hidden where they are to be found

Values = dict[str, float]


@dataclass(frozen=True)
class Hidden:
    """A mechanism, and what its team does not know of it.

    Args:
        mechanism: as drawn, nothing hidden yet.
        parts: the effects.
        sizes: name -> 1 if it is ordinary.
    """

    mechanism: Mechanism
    parts: tuple[Part, ...]
    sizes: Mapping[str, float]

    @property
    def told(self) -> dict[str, dict[str, float]]:
        """Name -> its numbers, for the key."""
        parts = {part.effect: dict(part.parameters) for part in self.parts}
        return {name: {"size": size, **parts.get(name, {})} for name, size in self.sizes.items()}


def hide(case: Case, *, rng: np.random.Generator) -> Hidden:
    """Draw a case's mechanism and the sizes of what is hidden in it.

    Args:
        case: what it is.
        rng: the source of chance.
    """
    mechanism = replace(
        MECHANISMS[case.mechanism].draw(rng), battery=STIFF, stator=UNLIMITED, supply=UNLIMITED,
        grip=None,
    )  # fmt: skip
    if any((case.mechanism, name) in GIVEN_AS_SIMPLE for name in case.hidden):
        mechanism = replace(mechanism, lift=0.0, type="simple")
    scale = replace(mechanism.scale, step=SLOWEST_STEP)
    bounds = A_THIRD if case.severity == SUBTLE else ORDINARY
    sizes = {name: float(rng.uniform(*bounds)) for name in case.hidden}
    parts = []
    for name in (one for one in case.hidden if one not in FAULTS):
        values = dict(find(name).example(scale, sizes[name]))
        shape = SHAPES.get(name)
        if shape is not None:
            values = shape(values, mechanism, scale, sizes[name], rng)
        parts.append(Part(name, values))
    return Hidden(mechanism, tuple(parts), sizes)


Shape = Callable[[Values, Mechanism, Scale, float, np.random.Generator], Values]


def _either_way(name: str, neutral: float = 0.0) -> Shape:
    """As often the other way round."""

    def shape(values: Values, *rest: object) -> Values:
        rng = rest[-1]
        return values | ({name: 2.0 * neutral - values[name]} if rng.random() < 0.5 else {})

    return shape


def _load(values: Values, mechanism: Mechanism, _: Scale, __: float, rng: object) -> Values:
    """Weight pulls down; a slope may lean either way."""
    if mechanism.name in ELEVATORS:
        return values
    return _either_way("load")(values, rng)


def _cogging(values: Values, _: Mechanism, __: Scale, ___: float, rng: object) -> Values:
    """Any phase, and from half to twice as many along the way."""
    size = math.hypot(values["cosine"], values["sine"])
    phase = rng.uniform(0.0, 2.0 * math.pi)
    return {
        "cosine": size * math.cos(phase),
        "sine": size * math.sin(phase),
        "turns": values["turns"] * float(rng.uniform(0.5, 2.0)),
    }


def _gravity(values: Values, mechanism: Mechanism, _: Scale, __: float, rng: object) -> Values:
    """An arm's zero is a little off level; what leans may lean any way."""
    size = math.hypot(values["level"], values["upright"])
    most = 0.6 if mechanism.name == "arm" else math.pi
    phase = float(rng.uniform(-most, most))
    return {"level": size * math.cos(phase), "upright": -size * math.sin(phase)}


def _spring(values: Values, mechanism: Mechanism, scale: Scale, _: float, rng: object) -> Values:
    """Relaxed somewhere along the way."""
    lowest = mechanism.lowest or 0.0
    relaxed = lowest + float(rng.uniform(0.2, 0.8)) * scale.reach
    return {"rate": values["rate"], "preload": -values["rate"] * relaxed}


def _sag(values: Values, *_: object) -> Values:
    """Of one motor, where the catalogue's example has four."""
    return values | {"share": values["share"] / 4.0}


def _stribeck(values: Values, *rest: object) -> Values:
    """Fading over more or less speed."""
    return values | {"slow": values["slow"] * float(rest[-1].uniform(0.6, 1.6))}


def _joint(values: Values, *rest: object) -> Values:
    """A lighter or heavier motor, more or less damping, friction at one side or both."""
    spans = {"share": (0.15, 0.5), "damping": (0.05, 0.3), "motor_friction": (0.0, 1.0)}
    return values | {name: float(rest[-1].uniform(*span)) for name, span in spans.items()}


def _inertia(values: Values, *rest: object) -> Values:
    """Taken up, at rest before or not; or given away."""
    rng = rest[-1]
    kind = rng.integers(3)
    extra = values["extra"] * (-0.7 if kind == 0 else 1.0)
    return values | {"extra": extra, "shared": float(kind == 2)}


def _current(values: Values, mechanism: Mechanism, scale: Scale, size: float, _: object) -> Values:
    """A bound on what a step has beyond holding still: nearly half of it for size 1."""
    holds = mechanism.gains["kS"] + abs(mechanism.gains.get("kG", 0.0))
    step = max(scale.step, holds + 1.2)
    return values | {"limit": holds + (step - holds) * max(1.0 - 0.45 * size, 0.2)}


def _bump(values: Values, mechanism: Mechanism, scale: Scale, _: float, rng: object) -> Values:
    """Somewhere along the way, all of which a ramp goes."""
    lowest = mechanism.lowest or 0.0
    return values | {"place": lowest + float(rng.uniform(0.2, 0.6)) * scale.reach}


def _rhythm(name: str) -> Shape:
    """Faster or slower."""

    def shape(values: Values, *rest: object) -> Values:
        return values | {name: values[name] * float(rest[-1].uniform(0.6, 1.5))}

    return shape


SHAPES: Mapping[str, Shape] = {
    "asymmetric-back-emf": _either_way("lean"),
    "asymmetric-friction": _either_way("lean"),
    "backlash": _joint,
    "battery-sag": _sag,
    "cogging": _cogging,
    "compliance": _joint,
    "constant-load": _load,
    "current-limit": _current,
    "gravity-cosine": _gravity,
    "inertia-change": _inertia,
    "spring": _spring,
    "stribeck": _stribeck,
    "velocity-scale": _either_way("scale", neutral=1.0),
    "bump": _bump,
    "band": _rhythm("at"),
    "swing": _rhythm("rate"),
    "push": _either_way("volts"),
    "dip": _rhythm("every"),
}
"""Name -> what else is drawn; the others are as their example says."""
