"""Pictures of gravity: windows and bands, in words and numbers."""

import pytest

from sim.core.errors import BadRequest
from sim.plot import plot_hold_angles, plot_hold_window

VOLTS, SPEEDS = [1.0, 1.5, 2.0, 2.5, 3.0], [-0.17, -0.06, 0.0, 0.05, 0.17]
HOLDS = [(-30.0, 1.06, 1.56), (0.0, 1.26, 1.76), (60.0, 0.50, 1.00)]


PICTURES = {
    "window": lambda: plot_hold_window(
        VOLTS, SPEEDS, window=(1.76, 2.26), marks={"recipe": 1.77}
    ),
    "window without marks": lambda: plot_hold_window(VOLTS, SPEEDS, window=(1.76, 2.26), marks={}),
    "angles": lambda: plot_hold_angles(HOLDS, kg=1.51, ks=0.25),
}  # fmt: skip


@pytest.mark.parametrize(
    ("volts", "said"),
    [(1.76, "lower edge"), (2.265, "upper edge"), (2.01, "middle"), (2.1, "inside"),
     (1.5, "below it"), (2.4, "above it")],
)  # fmt: skip
def test_a_mark_has_its_place_in_the_window_in_the_table(volts, said):
    table = plot_hold_window(VOLTS, SPEEDS, window=(1.76, 2.26), marks={"mark": volts}).table
    assert table.rows == (("mark", volts, said),)


@pytest.mark.parametrize(
    "draw",
    [
        lambda: plot_hold_window([1.0], [], window=(1.0, 2.0), marks={}),
        lambda: plot_hold_window([1.0], [0.0], window=(2.0, 1.0), marks={}),
    ],
    ids=["a missing speed", "edges swapped"],
)
def test_what_cannot_be_drawn_is_refused_with_advice(draw):
    with pytest.raises(BadRequest) as refused:
        draw()
    assert refused.value.advice
