"""Pictures of a log: damage stands where it is, gaps are named, and what is drawn is not all."""

from dataclasses import replace

import numpy as np
import pytest
from handmade import FOUR, log_of, run_of, with_gaps
from matplotlib.colors import same_color
from matplotlib.patches import Rectangle

from sim.core.errors import BadRequest
from sim.core.log import Log, Run
from sim.inspect.fault import Damage, LogInterval
from sim.plot import (
    plot_time_series,
    plot_timesteps,
    plot_voltage_velocity,
)
from sim.plot.picture import COLORS


def _boxes(picture):
    """(panel, left, right, bottom, top, frame's color) of each frame drawn around damage."""
    return [
        (place, *patch.get_bbox().intervalx, *patch.get_bbox().intervaly, patch.get_edgecolor())
        for place, axes in enumerate(picture.figure.axes)
        for patch in axes.patches
        if isinstance(patch, Rectangle) and not patch.get_fill()
    ]


def _damage(fault, run, start, end):
    """A fault so many seconds after its run began."""
    first = FOUR.runs[run].time[0]
    where = LogInterval(run, FOUR.runs[run].test, first + start, first + end)
    return Damage(fault, where, 0.9, "seen", "Run it again.")


@pytest.mark.parametrize(("run", "panels"), [(0, (0, 2)), (1, (0, 2)), (2, (1, 3)), (3, (1, 3))])
def test_damage_is_framed_around_its_own_curve(run, panels):
    picture = plot_time_series(FOUR, damages=[_damage("hard-stop", run, 4.0, 5.0)])
    boxes = _boxes(picture)
    assert tuple(box[0] for box in boxes) == panels  # voltage above, velocity below
    for (_, left, right, bottom, top, color), name in zip(
        boxes, ("voltage", "velocity"), strict=True
    ):
        assert (left, right) == pytest.approx((4.0, 5.0))
        within = getattr(FOUR.runs[run], name)[200:251]
        assert bottom < within.min()
        assert top > within.max()
        assert same_color(color, COLORS[run % 2])  # of the curve: forward or reverse


@pytest.mark.parametrize(
    "where",
    [
        LogInterval(4, "coast-forward", 0.0, 1.0),
        LogInterval(0, "quasistatic-forward", 11.5, 11.8),
    ],
    ids=["no such run", "no such time"],
)
def test_damage_of_another_log_is_refused(where):
    with pytest.raises(BadRequest) as refused:
        plot_time_series(FOUR, damages=[where])
    assert refused.value.advice


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
    "draw", [plot_time_series, plot_voltage_velocity, plot_timesteps], ids=lambda d: d.__name__
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
    [plot_time_series, plot_voltage_velocity, plot_timesteps],
    ids=lambda d: d.__name__,
)
def test_a_huge_log_makes_a_small_picture_that_counts_every_sample(draw, huge):
    picture = draw(huge)
    assert len(picture.svg) < 300_000
    assert any(count in str(picture.table) for count in ("20000", "19999"))


@pytest.mark.parametrize(
    "where",
    [
        LogInterval(None, "", 0.0, 0.0),
        LogInterval(None, "dynamic-reverse", 0.0, 0.0),
        LogInterval(1, "quasistatic-reverse", 0.0, 99.0),
        LogInterval(4, "coast-forward", 35.0, 36.0),
    ],
    ids=["the log", "no run", "a whole run", "a test of another kind"],
)
def test_whole_run_of_damage_that_no_box_can_show_is_told(where):
    log = replace(FOUR, runs=(*FOUR.runs, run_of("coast-forward")))
    picture = plot_time_series(log, damages=[where])
    assert where.test in picture.alt
    assert len(_boxes(picture)) == (2 if where.run == 1 else 0)


def test_much_damage_is_summed_up():
    picture = plot_time_series(
        FOUR, damages=[_damage("overrun", 0, 0.2 * i, 0.2 * i) for i in range(40)]
    )
    assert "The fault is in 34 more parts." in picture.alt
    assert len(picture.figure.legends[0].get_patches()) == 1


@pytest.mark.parametrize(
    "draw", [plot_time_series, plot_voltage_velocity], ids=lambda d: d.__name__
)
def test_one_sample_is_drawn(draw):
    one = Run("quasistatic-forward", [1.0], [0.5], [0.0], [0.0])
    picture = draw(Log((one,)))
    assert picture.svg
    assert "quasistatic" in str(picture) or "forward" in str(picture)
