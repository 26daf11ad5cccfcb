"""Functions of ``math`` that answer as compiled code does: nan or infinity, and no exception.

The uncompiled engine uses them, because a search also tries models that fly off.
"""

import math
from collections.abc import Callable

from math import copysign, hypot, inf, isnan, nan, pi  # isort: skip - those that never raise

__all__ = [
    "ceil", "copysign", "cos", "exp", "expm1", "hypot", "inf", "isnan", "log1p", "nan", "pi", "sin",
    "sqrt",
]  # fmt: skip

NO_INTEGER = -(2.0**63)  # what a processor makes of nan or infinity as an integer


def _quiet(function: Callable[[float], float]) -> Callable[[float], float]:
    """The same function, nan where it is not defined, and infinity where it overflows."""

    def answer(x: float) -> float:
        try:
            return function(x)
        except ValueError:
            return nan
        except OverflowError:
            return inf

    return answer


cos, sin, sqrt = _quiet(math.cos), _quiet(math.sin), _quiet(math.sqrt)
exp, expm1 = _quiet(math.exp), _quiet(math.expm1)


def log1p(x: float) -> float:
    """The logarithm of 1 + x; -infinity at -1, nan below."""
    return math.log1p(x) if x > -1.0 else -inf if x == -1.0 else nan


def ceil(x: float) -> float:
    """The next integer from x up; what a processor makes of nan and infinity."""
    return float(math.ceil(x)) if math.isfinite(x) else NO_INTEGER
