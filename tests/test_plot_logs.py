"""Pictures of a log: damage stands where it is, gaps are named, and what is drawn is not all."""

from dataclasses import replace

import numpy as np
import pytest
from handmade import FOUR, log_of, run_of, with_gaps
from matplotlib.colors import same_color

from sim.core.errors import BadRequest
from sim.core.log import Log, Run
from sim.inspect.fault import Damage, LogInterval
from sim.plot import (
    plot_time_series,
    plot_voltage_velocity,
)
from sim.plot.picture import COLORS


def _damage(fault, run, test="", start=0.0, end=0.0):
    return Damage(fault, LogInterval(run, test, start, end), 0.9, "seen", "Run it again.")


def _hatched(picture):
    """Panel, left and right end and edge color of each hatched part."""
    return [
        (place, *patch.get_bbox().intervalx, patch.get_edgecolor())
        for place, axes in enumerate(picture.figure.axes)
        for patch in axes.patches
    ]


@pytest.mark.parametrize(("run", "panels"), [(0, (0, 2)), (1, (0, 2)), (2, (1, 3)), (3, (1, 3))])
def test_damage_is_hatched_in_the_color_of_its_curve(run, panels):
    one = FOUR.runs[run]
    damage = _damage("hard-stop", run, one.test, one.time[0] + 4.0, one.time[0] + 5.0)
    picture = plot_time_series(FOUR, damages=[damage])

    hatched = _hatched(picture)
    assert tuple(place for place, *_ in hatched) == panels  # voltage above, velocity below
    for _, left, right, color in hatched:
        assert (left, right) == pytest.approx((4.0, 5.0))
        assert same_color(color, COLORS[run % 2])
    assert f"hard-stop in {one.test}, from 4.00 to 5.00 s." in picture.alt


@pytest.mark.parametrize(
    "damage",
    [
        _damage("odd-clock", None),
        _damage("missing-test", None, "dynamic-reverse"),
        _damage("hard-stop", 4, "coast-forward", 35.0, 36.0),
    ],
    ids=["the log", "no run", "a test of another kind"],
)
def test_damage_that_no_panel_can_show_is_told(damage):
    log = replace(FOUR, runs=(*FOUR.runs, run_of("coast-forward")))
    picture = plot_time_series(log, damages=[damage])
    assert damage.fault in picture.alt
    assert damage.where.test in picture.alt
    assert _hatched(picture) == []


ELEVATOR = replace(
    log_of("quasistatic-forward", "quasistatic-reverse", gravity=0.8), type="elevator"
)


def test_gravity_shows_on_both_sides_of_standstill():
    close = plot_voltage_velocity(ELEVATOR).figure.axes[1]
    left, right = close.get_xlim()
    assert left == -right
    low, high = close.get_ylim()
    assert low < 0.8 - 0.2 < 0.8 + 0.2 < high  # kG ± kS, where the two directions meet standstill


@pytest.mark.parametrize(
    "draw", [plot_time_series, plot_voltage_velocity], ids=lambda d: d.__name__
)
def test_an_empty_run_is_refused_with_advice(draw):
    with pytest.raises(BadRequest, match=r"Use a log"):
        draw(Log((Run("quasistatic-forward", *np.zeros((4, 0))),)))


@pytest.fixture(scope="module")
def huge():
    """Four tests of 20,000 samples, 5 ms apart, with noise, one spike and one gap each."""
    rng, runs = np.random.default_rng(4), []
    for run in log_of(*(run.test for run in FOUR.runs), seconds=100.0, period=0.005).runs:
        velocity = run.velocity + 0.03 * rng.standard_normal(len(run)) * (run.velocity != 0.0)
        velocity[7777] += 40.0
        runs.append(with_gaps(replace(run, velocity=velocity), {9000: 0.4}))
    return Log(tuple(runs))


@pytest.mark.parametrize(
    "draw",
    [plot_time_series, plot_voltage_velocity],
    ids=lambda d: d.__name__,
)
def test_a_huge_log_makes_a_small_picture_that_counts_every_sample(draw, huge):
    picture = draw(huge)
    assert len(picture.svg) < 300_000
    assert any(count in str(picture.table) for count in ("20000", "19999"))


@pytest.mark.parametrize(
    "draw", [plot_time_series, plot_voltage_velocity], ids=lambda d: d.__name__
)
def test_one_sample_is_drawn(draw):
    one = Run("quasistatic-forward", [1.0], [0.5], [0.0], [0.0])
    picture = draw(Log((one,)))
    assert picture.svg
    assert "quasistatic" in str(picture) or "forward" in str(picture)
