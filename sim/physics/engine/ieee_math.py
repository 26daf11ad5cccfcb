"""Functions of ``math`` that return nan or infinity, as compiled code does, and never raise.

The uncompiled engine uses them, because a search also tries models that diverge.
"""

import math
from collections.abc import Callable

from math import copysign, hypot, inf, isnan, nan, pi  # isort: skip - those that never raise

__all__ = [
    "ceil", "copysign", "cos", "exp", "expm1", "hypot", "inf", "isnan", "log1p", "nan", "pi", "sin",
    "sqrt",
]  # fmt: skip

NO_INTEGER = -(2.0**63)  # the integer to which a processor converts nan or infinity


def _without_exceptions(function: Callable[[float], float]) -> Callable[[float], float]:
    """The same function, nan where it is not defined, and infinity where it overflows."""

    def wrapped(x: float) -> float:
        try:
            return function(x)
        except ValueError:
            return nan
        except OverflowError:
            return inf

    return wrapped


cos, sin, sqrt, exp, expm1 = map(
    _without_exceptions, (math.cos, math.sin, math.sqrt, math.exp, math.expm1)
)


def log1p(x: float) -> float:
    """The logarithm of 1 + x; -infinity at -1, nan below."""
    return math.log1p(x) if x > -1.0 else -inf if x == -1.0 else nan


def ceil(x: float) -> float:
    """The smallest integer that is not below x; ``NO_INTEGER`` for nan and infinity."""
    return float(math.ceil(x)) if math.isfinite(x) else NO_INTEGER
