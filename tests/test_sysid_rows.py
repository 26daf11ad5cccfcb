"""Trimming, filtering and differentiating, on the examples of SysId's own unit tests."""

import numpy as np
import pytest

from sim.fit.sysid_rows import Rows, estimate_noise_floor, median_filter, trim_step


def test_a_median_of_three_is_sysids_own():
    values = np.array([0, 1, 10, 5, 3, 0, 1000, 7, 6, 5], dtype=float)

    assert median_filter(values, window=3).tolist() == [0, 1, 5, 5, 3, 3, 7, 7, 6, 5]


@pytest.mark.parametrize("window", [2, 3, 4, 5, 7, 15])
def test_a_median_is_fed_as_sysid_feeds_its_buffer(window):
    values = np.random.default_rng(window).normal(size=40)
    ahead = (window - 1) // 2
    held = [values[0]] * window
    expected = []
    for value in [*values[ahead:], *[values[-1]] * ahead]:
        held = [*held[1:], value]
        expected.append(np.median(held))

    assert median_filter(values, window=window) == pytest.approx(expected)


def test_the_noise_floor_is_sysids_own():
    velocity = np.array([0, 1, 2, 5, 0.35, 0.15, 0, 0.02, 0.01, 0])

    assert estimate_noise_floor(velocity, window=2) == pytest.approx(0.953, abs=1e-3)


@pytest.mark.parametrize(
    ("acceleration", "duration"),
    [  # SysId's tests say 3, 3, 4 s: there its least duration, 2 s, is added; in its app it is 0
        ([0, 0.25, 10, 0.45, 0, 0.15, 0, 0.02, 0, 0], 1.0),
        ([0, -0.46, -8, -0.32, -0.12, -0.08, -0.06, -0.02, 0, 0], 1.0),
        ([0, 0.41, 11.5, 1.2, 0.34, 0.25, 0.11, -0.08, -12, 0], 2.0),
    ],
    ids=["forward", "reverse", "a late spike backward must not win"],
)
def test_a_step_is_cut_from_its_peak_on(acceleration, duration):
    acceleration = np.array(acceleration, dtype=float)
    velocity = np.concatenate(([0.0], np.cumsum(acceleration)[:-1]))
    sign = np.sign(acceleration[2])
    rows = Rows(
        np.arange(10.0),
        np.ones(10),
        sign * np.ones(10),
        np.cumsum(velocity),
        velocity,
        acceleration,
    )

    step = trim_step(rows, threshold=0.2, duration=0.0, longest=9.0)

    assert step.duration == duration
    assert step.rows.time[0] == 2.0  # where the acceleration peaks
    assert step.rows.time[-1] == 2.0 + duration


def test_a_given_duration_is_kept():
    time = np.arange(0, 2, 0.02)
    velocity = 1 - np.exp(-time / 0.2)
    rows = Rows(time, np.full(100, 0.02), np.ones(100), time, velocity, np.exp(-time / 0.2) / 0.2)

    step = trim_step(rows, threshold=0.01, duration=0.5, longest=2.0)

    assert step.duration == 0.5
    assert len(step.rows) == 26  # from t = 0 to t = 0.5 s, both included
