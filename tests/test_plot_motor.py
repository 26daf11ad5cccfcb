"""Pictures of the first lessons: a gauge, a change."""

import pytest

from sim.core.errors import BadRequest
from sim.plot import (
    plot_gauge,
)
from sim.plot.gauge import find_band

BANDS = {"fine": 0.5, "watch": 5.0, "stop": 6.0}
PICTURES = {
    "gauge": lambda: plot_gauge({"left": 0.2, "right": 0.9}, BANDS, label="kS [V]", good="fine"),
}


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
        (lambda: plot_gauge({}, BANDS, label="", good="fine"), "a larger end"),
        (lambda: plot_gauge({"x": 1.0}, BANDS, label="", good="best"), "a larger end"),
        (lambda: plot_gauge({"x": 1.0}, {"a": 2.0, "b": 1.0}, label="", good="a"), "a larger end"),
    ],
    ids=[
        "no number",
        "no good",
        "falling",
    ],
)
def test_what_cannot_be_drawn_is_refused_with_advice(draw, advice):
    with pytest.raises(BadRequest, match=advice):
        draw()
