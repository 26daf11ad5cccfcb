"""The gaps of lesson 7: empty, right, wrong, or broken."""

import numpy as np
import pytest

from sim.teaching.fit_gaps import compute_gains, fill_gaps, make_columns, put_acceleration_left


def filled(
    left=lambda _volts, _v, a: a,
    columns=lambda volts, v, _a: [v, volts, np.sign(v)],
    gains=lambda alpha, beta, gamma: {"kS": -gamma / beta, "kV": -alpha / beta, "kA": 1 / beta},
):
    return fill_gaps(left=left, columns=columns, gains=gains)


def test_right_lines_are_reported_and_used():
    mine = filled()

    assert mine.report.splitlines() == ["Gap 1: right.", "Gap 2: right.", "Gap 3: right."]
    assert mine.left is not put_acceleration_left
    assert mine.columns is not make_columns


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"left": lambda *_: ...}, "Gap 1: still empty"),
        ({"left": lambda volts, *_: volts}, "Gap 1: not yet. Which signal is noisiest?"),
        ({"columns": lambda volts, v, _: [v, volts, ...]}, "Gap 2: still empty"),
        ({"columns": lambda volts, v, _: [v, volts, np.ones_like(v)]}, "Gap 2: not yet."),
        ({"columns": lambda volts, v, _: [v, volts]}, "Gap 2: it stops with an error"),
        ({"columns": lambda volts, v, _: [v, volts, 1]}, "A column needs a number for each row"),
        ({"columns": lambda *_: nothing}, "Gap 2: it stops with an error: name 'nothing'"),  # noqa: F821 - meant
        ({"columns": lambda volts, v, _: [v, volts, Math.signum(v)]}, "NumPy: np.pi,"),  # noqa: F821 - Java's
        ({"gains": lambda *_: {"kS": ..., "kV": ..., "kA": ...}}, "Gap 3: still empty"),
        (
            {"gains": lambda alpha, beta, gamma: {"kS": -gamma, "kV": alpha, "kA": beta}},
            "Gap 3: not yet. Use kV",
        ),
        ({"gains": lambda *_: {"kS": 1.0}}, "Gap 3: it stops with an error"),
        ({"gains": lambda *_: None}, "Gap 3: not yet."),
    ],
)
def test_wrong_lines_get_advice_and_are_replaced_by_right_ones(wrong, says):
    mine = filled(**wrong)
    (name,) = wrong

    assert says in mine.report
    assert mine.report.count("right.") == 2
    ours = {"left": put_acceleration_left, "columns": make_columns, "gains": compute_gains}
    assert getattr(mine, name) is ours[name]
