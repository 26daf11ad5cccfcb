"""The time between samples: every gap is counted, the long ones are named and marked."""

import numpy as np
import pytest
from handmade import FOUR, with_gaps

from sim.core.errors import BadRequest
from sim.core.log import Log, Run
from sim.plot import plot_timesteps

GAPPY = Log((with_gaps(FOUR.runs[0], {50: 0.104, 200: 0.05, 300: 0.029}), FOUR.runs[2]))


def test_a_gap_is_named_counted_and_marked():
    picture = plot_timesteps(GAPPY)
    # 0.104 s and 0.05 s are longer than 1.5 × 20 ms, 0.029 s is not; 2 of 998 steps
    assert [row[5:] for row in picture.table.rows] == [(2, "0.401 %"), (0, "0 %")]
    marks = [line for line in picture.figure.axes[0].lines if line.get_label() == "a gap"]
    assert [list(np.round(mark.get_ydata())) for mark in marks] == [[104.0, 50.0]]
    assert picture.figure.axes[0].get_title() == "quasistatic-forward: 2 gaps"


def test_a_log_without_gaps_says_so():
    picture = plot_timesteps(FOUR)
    assert all("no gaps" in axes.get_title() for axes in picture.figure.axes)


def test_a_gap_longer_than_the_panel_is_at_its_edge_with_its_true_length_in_the_table():
    picture = plot_timesteps(Log((with_gaps(FOUR.runs[0], {50: 2.5}),)))
    assert picture.table.rows[0][4] == 2500.0
    (mark,) = (line for line in picture.figure.axes[0].lines if line.get_label() == "a longer gap")
    low, high = picture.figure.axes[0].get_ylim()
    assert low < mark.get_ydata()[0] < high < 2500.0


def test_one_sample_has_no_time_to_the_next():
    with pytest.raises(BadRequest) as refused:
        plot_timesteps(Log((Run("quasistatic-forward", [1.0], [0.5], [0.0], [0.0]),)))
    assert refused.value.advice
