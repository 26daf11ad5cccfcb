"""Pictures of gravity and of what tests tell: windows, bands and ellipses, in words and numbers."""

from functools import cache

import numpy as np
import pytest

import sim
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.fit.information_matrix import compute_information
from sim.fit.sysid_rows import prepare_rows
from sim.plot import plot_ellipses, plot_hold_angles, plot_hold_window, plot_information_map

VOLTS, SPEEDS = [1.0, 1.5, 2.0, 2.5, 3.0], [-0.17, -0.06, 0.0, 0.05, 0.17]
NAMES, TRUTH, REACH = ("kS [V]", "kG [V]"), (0.25, 2.01), (0.3, 0.3)
HOLDS = [(-30.0, 1.06, 1.56), (0.0, 1.26, 1.76), (60.0, 0.50, 1.00)]


@cache
def rows():
    """An elevator's four tests, as a fit sees them."""
    log = simulate(sim.MECHANISMS["elevator"], sim.Routine(step=4.5), rng=np.random.default_rng(1))
    return prepare_rows(log).rows


def some(way):
    return {test: part for test, part in rows().items() if test.endswith(way)}


def about(part):
    return compute_information(part, type="elevator", noise=0.05).compute_pair_information(
        "kS", "kG"
    )


PICTURES = {
    "window": lambda: plot_hold_window(
        VOLTS, SPEEDS, window=(1.76, 2.26), marks={"recipe": 1.77}
    ),
    "window without marks": lambda: plot_hold_window(VOLTS, SPEEDS, window=(1.76, 2.26), marks={}),
    "angles": lambda: plot_hold_angles(HOLDS, kg=1.51, ks=0.25),
    "angles of an encoder askew": lambda: plot_hold_angles(HOLDS, kg=1.51, ks=0.25, offset=35.0),
    "ellipses": lambda: plot_ellipses(
        {"up": about(some("forward")), "both": about(rows())},
        names=NAMES, truth=TRUTH, reach=REACH,
    ),
    "map": lambda: plot_information_map(
        rows(), about(rows()), names=NAMES, truth=TRUTH, reach=REACH
    ),
}  # fmt: skip


@pytest.mark.parametrize(
    ("volts", "said"),
    [(1.76, "lower edge"), (2.265, "upper edge"), (2.01, "middle"), (2.1, "inside"),
     (1.5, "below it"), (2.4, "above it")],
)  # fmt: skip
def test_a_mark_is_told_where_in_the_window_it_lies(volts, said):
    table = plot_hold_window(VOLTS, SPEEDS, window=(1.76, 2.26), marks={"mark": volts}).table
    assert table.rows == (("mark", volts, said),)


def test_the_errors_of_a_whole_log_are_those_of_the_rows():
    errors = compute_information(rows(), type="elevator", noise=0.05).errors
    said = [float(cell) for cell in PICTURES["map"]().table.rows[0][1:]]
    assert said == pytest.approx([errors["kS"], errors["kG"]], rel=0.01)


@pytest.mark.parametrize(
    "draw",
    [
        lambda: plot_hold_window([1.0], [], window=(1.0, 2.0), marks={}),
        lambda: plot_hold_window([1.0], [0.0], window=(2.0, 1.0), marks={}),
        lambda: plot_ellipses({}, names=NAMES, truth=TRUTH, reach=REACH),
    ],
    ids=["a missing speed", "edges swapped", "no rows"],
)
def test_what_cannot_be_drawn_is_refused_with_advice(draw):
    with pytest.raises(BadRequest) as refused:
        draw()
    assert refused.value.advice
