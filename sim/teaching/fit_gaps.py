"""The three blanks of a least-squares fit that a student fills in, each checked at once.

a = α·v + β·V + γ·sgn(v)        kS = −γ/β, kV = −α/β, kA = 1/β
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from textwrap import fill
from typing import Any, NamedTuple

import numpy as np

from sim.core.log import Array

SAMPLES = 12  # rows on which a student's line is compared with the right one
WIDTH = 80  # [characters] of a printed line; JupyterLab breaks longer ones inside a word
CLOSE = 2e-3  # [1] relative tolerance: 3.14 for π and 9.8 for g are right

Signals = Callable[[Array, Array, Array], object]
Solved = Callable[[float, float, float], object]


@dataclass(frozen=True)
class FilledGaps:
    """The three lines of a lesson's fit that the student fills in; a wrong one is replaced.

    Args:
        left: function of voltage, velocity and acceleration, (n,) each; the left side, (n,).
        columns: function of the same; the columns of α, β and γ, (n,) each.
        gains: function of α, β and γ; kS [V], kV and kA.
        report: the feedback to each blank.
    """

    left: Callable[[Array, Array, Array], Array]
    columns: Callable[[Array, Array, Array], Sequence[Array]]
    gains: Callable[[float, float, float], Mapping[str, float]]
    report: str


def put_acceleration_left(_volts: Array, _velocity: Array, acceleration: Array) -> Array:
    """The acceleration (n,), the noisiest signal."""
    return acceleration


def make_columns(volts: Array, velocity: Array, _acceleration: Array) -> list[Array]:
    """The columns of α, β and γ, each (n,)."""
    return [velocity, volts, np.sign(velocity)]


def compute_gains(alpha: float, beta: float, gamma: float) -> dict[str, float]:
    """The gains kS [V], kV and kA from the three numbers of the fit."""
    return {"kS": -gamma / beta, "kV": -alpha / beta, "kA": 1.0 / beta}


def fill_gaps(*, left: Signals, columns: Signals, gains: Solved) -> FilledGaps:
    """Check what a student wrote into the three blanks, on random rows.

    Args:
        left: blank 1, as ``FilledGaps.left``; ``...`` is an empty blank, as in the other two.
        columns: blank 2, as ``FilledGaps.columns``.
        gains: blank 3, as ``FilledGaps.gains``.
    """
    rng = np.random.default_rng(7)
    rows = tuple(rng.standard_normal(SAMPLES) for _ in range(3))
    (first, second, third), report = judge_gaps(
        "Gap",
        Gap(left, put_acceleration_left, rows, "Which signal is noisiest?"),
        Gap(
            columns,
            make_columns,
            rows,
            "What is γ multiplied by in the equation for a? NumPy calls it np.sign(v).",
        ),
        Gap(gains, compute_gains, (-8.0, 3.0, -0.5), "Use kV = −α/β and kA = 1/β."),
    )
    return FilledGaps(first, second, third, report)


RIGHT, EMPTY = "right.", "still empty. Put your answer in place of the three dots."


class Gap(NamedTuple):
    """A blank: the student's function, the right one, example arguments, and a hint."""

    mine: Callable[..., object]
    right: Callable[..., Any]
    example: tuple[Any, ...]
    hint: str


def judge_gaps(label: str, *gaps: Gap) -> tuple[list[Callable[..., Any]], str]:
    """The student's functions, each replaced by the right one if it is wrong, and the feedback.

    Args:
        label: name of a blank in the feedback.
        gaps: the blanks.
    """
    found = [
        judge_gap(partial(gap.mine, *gap.example), gap.right(*gap.example), gap.hint)
        for gap in gaps
    ]
    functions = [
        gap.mine if text == RIGHT else gap.right for gap, text in zip(gaps, found, strict=True)
    ]
    lines = (fill(f"{label} {k}: {text}", WIDTH) for k, text in enumerate(found, start=1))
    return functions, "\n".join(lines)


def judge_gap(
    answer: Callable[[], object], expected: object, hint: str | Callable[[float], str]
) -> str:
    """The feedback to one blank: right, still empty, an error, or not yet with a hint.

    Args:
        answer: returns the student's answer.
        expected: the right answer: a number, arrays of one shape, or a dict of numbers.
        hint: the hint for a wrong answer, or a function that chooses it by the answer.
    """
    try:
        found = answer()
        if isinstance(expected, dict):
            found = [found[name] for name in expected] if isinstance(found, dict) else found
            expected = list(expected.values())
        if found is ... or (isinstance(found, list | tuple) and any(one is ... for one in found)):
            return EMPTY
        same = np.allclose(np.asarray(found, dtype=float), np.asarray(expected), rtol=CLOSE)
        said = hint(float(found)) if callable(hint) else hint  # type: ignore[arg-type]  # a number, as what is expected
    except NameError as error:
        names = "Use the names in the parentheses of def, and NumPy: np.pi, np.sign(v)."
        return f"it stops with an error: {error}. {names}"
    except Exception as error:  # noqa: BLE001 - a student's line may fail in any way
        if "inhomogeneous" in str(error):
            return f"not yet. A column needs a number for each row; one of yours has not. {hint}"
        return f"it stops with an error: {error}."
    return RIGHT if same else f"not yet. {said}"
