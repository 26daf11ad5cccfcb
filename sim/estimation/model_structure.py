"""A model structure: the base model and a set of effects, with their parameters."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from inspect import signature

from sim.physics.effect import Parameter
from sim.physics.effects import EFFECTS
from sim.physics.model import Model, Part

BASE: Mapping[str, tuple[str, ...]] = {
    "simple": ("kS", "kV", "kA"),
    "elevator": ("kS", "kV", "kA", "kG"),
    "arm": ("kS", "kV", "kA", "level", "upright"),
}
POSITIVE = ("kV", "kA")
ORDINARY: Mapping[str, float] = {"V": 0.05, "s": 0.004, "1": 0.02}
"""Unit -> typical size of a parameter whose value is near zero; sets the steps of a search."""


@dataclass(frozen=True)
class ModelStructure:
    """The base model and the effects that are assumed.

    Args:
        type: ``simple``, ``elevator`` or ``arm``.
        effects: names of the effects, in the order in which they were added.
        fixed: parameters that a search does not change.
    """

    type: str
    effects: tuple[str, ...] = ()
    fixed: tuple[str, ...] = ()

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of all parameters: gains, then ``effect.parameter``."""
        return (*BASE[self.type], *self.parameters)

    @cached_property
    def parameters(self) -> Mapping[str, Parameter]:
        """``effect.parameter`` -> its definition in the effect."""
        return {
            f"{name}.{one.name}": one for name in self.effects for one in EFFECTS[name].parameters
        }

    @cached_property
    def searched_names(self) -> tuple[str, ...]:
        """Names of the parameters that a search changes; the others keep their start values."""
        known = self.parameters
        return tuple(
            name
            for name in self.names
            if name not in self.fixed and (name not in known or known[name].searched)
        )

    @cached_property
    def free_count(self) -> int:
        """Number of parameters that the data determine, also of those with fixed start values."""
        known = self.parameters
        return sum(1 for name in self.names if name not in known or known[name].counts)

    @cached_property
    def backlash_names(self) -> tuple[str, ...]:
        """Names of the parameters that are the width of a backlash."""
        acts = {name: EFFECTS[name].hooks.get("backlash_gap") for name in self.effects}
        return tuple(
            f"{name}.{one}"
            for name, act in acts.items()
            if act
            for one in signature(act).parameters
        )

    @property
    def has_backlash(self) -> bool:
        """Whether there is backlash between motor and load."""
        return bool(self.backlash_names)

    @property
    def has_joint(self) -> bool:
        """Whether motor and load are two bodies."""
        return any(EFFECTS[name].is_joint for name in self.effects)

    def __add__(self, effect: str) -> "ModelStructure":
        return ModelStructure(self.type, (*self.effects, effect))

    def __sub__(self, effect: str) -> "ModelStructure":
        return ModelStructure(self.type, tuple(name for name in self.effects if name != effect))

    def model(self, values: Mapping[str, float]) -> Model:
        """The model with these values; ``level`` and ``upright`` give kG and offset of an arm."""
        gains = {name: values[name] for name in BASE[self.type] if name.startswith("k")}
        if self.type == "arm":
            gains["kG"] = math.hypot(values["level"], values["upright"])
            gains["offset_rad"] = math.atan2(-values["upright"], values["level"])
        model = Model(self.type, gains)
        for name in self.effects:
            model += Part(name, {p: values[f"{name}.{p}"] for p in EFFECTS[name].names})
        return model

    @staticmethod
    def split_model(model: Model) -> tuple["ModelStructure", dict[str, float]]:
        """The structure of a model, and the values of its parameters: the inverse of ``model``."""
        values = dict(model.gains)
        if model.type == "arm":
            size, angle = values.pop("kG"), values.pop("offset_rad")
            values |= {"level": size * math.cos(angle), "upright": -size * math.sin(angle)}
        for part in model.parts:
            values |= {f"{part.effect}.{name}": value for name, value in part.parameters.items()}
        return ModelStructure(model.type, tuple(part.effect for part in model.parts)), values

    def find_parameter_scale(self, name: str, value: float) -> float:
        """Typical size of a parameter, in its unit: its value, or an ordinary one if larger."""
        if name in POSITIVE:
            return abs(value)
        known = self.parameters.get(name)
        if known is None:
            return max(abs(value), ORDINARY["V"])
        return max(abs(value), ORDINARY.get(known.unit, 0.0), 1e-12)

    def clamp_value(self, name: str, value: float) -> float:
        """The value of a parameter, clamped to its physical limits."""
        known = self.parameters.get(name)
        if known is not None:
            return min(max(value, known.least), known.most)
        return max(value, 0.0) if name == "kS" else value

    def step_value(self, name: str, value: float, by: float) -> float:
        """The value of a parameter after a step; a positive one changes by a limited factor."""
        if name in POSITIVE:
            return value * min(max(1.0 + by / value, 1.0 / 3.0), 3.0)
        known = self.parameters.get(name)
        if known is not None and known.least >= 0.0 and math.isfinite(by):
            size = self.find_parameter_scale(name, value)
            by = min(max(by, -0.7 * size), 2.0 * size)
        return self.clamp_value(name, value + by)
