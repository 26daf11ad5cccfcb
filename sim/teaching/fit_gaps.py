"""The three blanks of a least-squares fit that a student fills in, each checked at once.

a = α·v + β·V + γ·sgn(v)        kS = −γ/β, kV = −α/β, kA = 1/β
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from textwrap import fill

import numpy as np

from sim.core.log import Array

WIDTH = 80  # [characters] of a printed line; JupyterLab breaks longer ones inside a word
SAMPLES = 12  # rows on which a student's line is compared with the right one
CLOSE = 1e-9  # [1] relative tolerance for rounding errors

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
    solved = (-8.0, 3.0, -0.5)
    first = judge_gap(
        lambda: left(*rows), put_acceleration_left(*rows), "Which signal is noisiest?"
    )
    second = judge_gap(
        lambda: columns(*rows),
        make_columns(*rows),
        "What is γ multiplied by in the equation for a? NumPy calls it np.sign(v).",
    )
    third = judge_gap(
        lambda: _in_order(gains(*solved)),
        list(compute_gains(*solved).values()),
        "Use kV = −α/β and kA = 1/β.",
    )
    feedback = (first, second, third)
    right = [one == RIGHT for one in feedback]
    return FilledGaps(
        left if right[0] else put_acceleration_left,  # type: ignore[arg-type]  # judged to return such an array
        columns if right[1] else make_columns,  # type: ignore[arg-type]  # the same
        gains if right[2] else compute_gains,  # type: ignore[arg-type]  # the same
        format_report("Gap", feedback),
    )


def format_report(label: str, feedback: Sequence[str]) -> str:
    """The feedback to each blank, numbered and wrapped."""
    return "\n".join(fill(f"{label} {k}: {one}", WIDTH) for k, one in enumerate(feedback, start=1))


RIGHT, EMPTY = "right.", "still empty. Put your answer in place of the three dots."


def _in_order(gains: object) -> object:
    """The gains kS, kV and kA as a list, if they are a dict; other values unchanged."""
    return [gains[name] for name in ("kS", "kV", "kA")] if isinstance(gains, dict) else gains


def judge_gap(answer: Callable[[], object], expected: object, hint: str) -> str:
    """The feedback to one blank: right, still empty, an error, or not yet with a hint.

    Args:
        answer: returns the student's answer.
        expected: the right answer: a number, or arrays of one shape.
        hint: the hint for a wrong answer.
    """
    try:
        found = answer()
        if found is ... or (isinstance(found, list | tuple) and any(one is ... for one in found)):
            return EMPTY
        same = np.allclose(np.asarray(found, dtype=float), np.asarray(expected), rtol=CLOSE)
    except Exception as error:  # noqa: BLE001 - a student's line may fail in any way
        if "inhomogeneous" in str(error):
            return f"not yet. A column needs a number for each row; one of yours has not. {hint}"
        return f"it stops with an error: {error}."
    return RIGHT if same else f"not yet. {hint}"
