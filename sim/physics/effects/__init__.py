"""The effects that a model may contain, one file each: the physics we can name."""

import sys
from typing import cast

from sim.core.errors import BadRequest
from sim.physics.effect import Effect
from sim.support.catalogue import list_members

EFFECTS: dict[str, Effect] = {
    name: cast("Effect", module.EFFECT)
    for name, module in list_members(sys.modules[__name__]).items()
}


def find_motion_class(name: str) -> str:
    """The common name of effects that look alike while the mechanism moves.

    Args:
        name: of an effect; any other name, as that of a fault, stands for itself.

    Examples:
        >>> find_motion_class("asymmetric-friction")
        'constant-load'
    """
    known = EFFECTS.get(name)
    return known.same_in_motion or name if known else name


def find_effect(name: str) -> Effect:
    """Look up an effect.

    Raises:
        BadRequest: no such effect; the message lists those there are.

    Examples:
        >>> find_effect("drag").names
        ('drag',)
    """
    if name not in EFFECTS:
        raise BadRequest(f"unknown effect {name!r}", advice=f"Choose one of: {', '.join(EFFECTS)}.")
    return EFFECTS[name]
