"""A model: gains plus effects.

    V = kS·sgn(v) + kV·v + kA·a + gravity + Σ effects

``model + Part("drag", {...})`` is another model.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from sim.core.errors import BadRequest, refuse_unknown
from sim.core.log import TYPES
from sim.core.units import Unit
from sim.physics.effect import are_compatible
from sim.physics.effects import find_effect


@dataclass(frozen=True)
class Part:
    """An effect with its parameters.

    Args:
        effect: name of the effect.
        parameters: parameter -> value, in SI.

    Raises:
        BadRequest: no such effect, or a parameter is missing, unknown or not physical.
    """

    effect: str
    parameters: Mapping[str, float]

    def __post_init__(self) -> None:
        known = find_effect(self.effect)
        if set(self.parameters) != set(known.names):
            raise BadRequest(
                f"{self.effect} has other parameters than {', '.join(self.parameters) or 'none'}",
                advice=f"Give: {', '.join(known.names)}.",
            )
        for parameter in known.parameters:
            value = self.parameters[parameter.name]
            if not parameter.least <= value <= parameter.most:
                raise BadRequest(
                    f"{self.effect}: {parameter.name} is {value:g}",
                    advice=f"Choose {parameter.least:g} to {parameter.most:g}.",
                )

    def to_json(self, per: Unit) -> dict[str, dict[str, float | str]]:
        """The parameters in a unit of position, for JSON: name -> its value and its unit.

        Args:
            per: the unit of position.
        """
        return {
            parameter.name: {
                "value": self.parameters[parameter.name] * per.si**parameter.power,
                "unit": parameter.unit.format(u=per.symbol),
            }
            for parameter in find_effect(self.effect).parameters
        }


@dataclass(frozen=True)
class Model:
    """A model of a mechanism: gains, effects and travel.

    Args:
        type: ``simple``, ``elevator`` or ``arm``.
        gains: kS [V], kV, kA, and kG [V] (with ``offset_rad`` for an arm) where there is gravity.
        parts: the effects on top; each at most once.
        travel: [m or rad] the lower and the upper stop; None has none.

    Raises:
        BadRequest: an unknown type, an effect that is there twice, or slip together with a joint.

    Examples:
        >>> plain = Model("simple", {"kS": 0.1, "kV": 2.5, "kA": 0.4})
        >>> model = plain + Part("drag", {"drag": 0.02})
        >>> [part.effect for part in model.parts]
        ['drag']
    """

    type: str
    gains: Mapping[str, float]
    parts: tuple[Part, ...] = field(default=())
    travel: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        refuse_unknown("type", self.type, TYPES)
        names = [part.effect for part in self.parts]
        if twice := [name for name in names if names.count(name) > 1]:
            raise BadRequest(f"{twice[0]} is there twice", advice="Add each effect once.")
        if not are_compatible(map(find_effect, names)):
            raise BadRequest(
                f"{' and '.join(names)} cannot be in one model",
                advice="Choose slipping wheels or a joint (backlash, compliance), not both.",
            )

    def __add__(self, part: Part) -> "Model":
        return replace(self, parts=(*self.parts, part))
