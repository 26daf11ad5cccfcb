"""The catalogue of effects that a model may contain, one file each."""

import sys

from sim.core.errors import refuse_unknown
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


def list_look_alikes(name: str) -> dict[str, str]:
    """Similar effect -> the test that tells the two apart, from either file."""
    own = dict(find_effect(name).apart)
    return own | {other: one.apart[name] for other, one in EFFECTS.items() if name in one.apart}


def find_effect(name: str) -> Effect:
    """Look up an effect.

    Raises:
        BadRequest: no such effect; the message lists those there are.

    Examples:
        >>> find_effect("drag").names
        ('drag',)
    """
    refuse_unknown("effect", name, EFFECTS)
    return EFFECTS[name]
