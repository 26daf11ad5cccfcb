"""The catalogue of effects that a model may contain, one file each."""

import sys

from sim.core.errors import BadRequest
from sim.physics.effect import Effect
from sim.support.catalogue import load_catalogue

EFFECTS = load_catalogue(sys.modules[__name__], Effect)


def find_motion_class(name: str) -> str:
    """The common name of effects that act the same while the mechanism moves.

    Args:
        name: name of an effect; any other name, like that of a fault, is returned unchanged.

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
