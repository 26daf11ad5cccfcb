"""Pictures of the first lessons: a chase, a gauge, a change."""

import numpy as np
import pytest

from sim.core.errors import BadRequest
from sim.plot import (
    measure_tracking_error,
    plot_gauge,
    plot_tracking_error,
)
from sim.plot.gauge import find_band

TIME = np.linspace(0.0, 2.0, 41)
BANDS = {"fine": 0.5, "watch": 5.0, "stop": 6.0}
PICTURES = {
    "chase": lambda: plot_tracking_error(TIME, TIME, {"a": TIME + 0.1, "b": TIME}, title="A race"),
    "gauge": lambda: plot_gauge({"left": 0.2, "right": 0.9}, BANDS, label="kS [V]", good="fine"),
}


def test_a_miss_is_the_root_mean_square_and_the_largest():
    off = measure_tracking_error(np.zeros(4), np.array([0.0, 3.0, -4.0, 0.0]))
    assert off.typical == pytest.approx(2.5)  # √((9 + 16) / 4)
    assert off.largest == 4.0


@pytest.mark.parametrize(
    ("value", "band"),
    [(0.0, "fine"), (0.5, "fine"), (0.51, "watch"), (5.1, "stop"), (99.0, "stop")],
)
def test_a_number_lies_in_its_band(value, band):
    assert find_band(value, BANDS) == band
    assert plot_gauge({"x": value}, BANDS, label="kS [V]", good="fine").table.rows == (
        ("x", value, band),
    )


@pytest.mark.parametrize(
    ("draw", "advice"),
    [
        (lambda: plot_tracking_error(TIME, TIME, {}), "Give one or more"),
        (lambda: plot_tracking_error(TIME, TIME, {"a": TIME[1:]}), "of equal length"),
        (lambda: plot_gauge({}, BANDS, label="", good="fine"), "a larger end"),
        (lambda: plot_gauge({"x": 1.0}, BANDS, label="", good="best"), "a larger end"),
        (lambda: plot_gauge({"x": 1.0}, {"a": 2.0, "b": 1.0}, label="", good="a"), "a larger end"),
    ],
    ids=[
        "nobody",
        "a short one",
        "no number",
        "no good",
        "falling",
    ],
)
def test_what_cannot_be_drawn_is_refused_with_advice(draw, advice):
    with pytest.raises(BadRequest, match=advice):
        draw()
