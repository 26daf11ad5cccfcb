"""Many fits in one picture: badges, and the truth beside them or hidden."""

import pytest

from sim.core.errors import BadRequest
from sim.plot import plot_r2_vs_gain_error

SCORES = {"clean": 0.99, "a jump": 0.92, "spikes": 0.81}
OFF = {
    "kV": {"clean": 0.0, "a jump": 0.01, "spikes": 0.05},
    "kA": {"clean": 0.02, "a jump": 1.49, "spikes": -6.48},
}


def drawn(**changes):
    return plot_r2_vs_gain_error(SCORES, **({"good": 0.9, "score": "sim R²", "off": OFF} | changes))


def test_a_badge_says_by_sign_and_number_whether_it_passes():
    texts = [text.get_text() for text in drawn().figure.axes[0].texts]

    assert texts == ["✓ 0.99", "✓ 0.92", "✗ 0.81"]


def test_hidden_errors_are_neither_drawn_nor_told():
    picture = drawn(off=None)

    assert "hidden" in picture.alt
    assert "648" not in picture.html
    assert not picture.figure.axes[1].lines


@pytest.mark.parametrize(
    ("scores", "off"), [({}, None), (SCORES, {"kA": {"clean": 0.0}})], ids=["none", "one lacks"]
)
def test_what_cannot_be_drawn_is_refused(scores, off):
    with pytest.raises(BadRequest, match="Give one or more"):
        plot_r2_vs_gain_error(scores, good=0.9, score="R²", off=off)
