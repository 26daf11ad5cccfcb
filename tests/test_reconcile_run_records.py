"""Where each run of a log lies on a stop when it begins."""

import math

import numpy as np
import pytest

from sim.core.log import Log, Run
from sim.estimation.run_records import make_run_records

TIME = np.arange(0.0, 4.0, 0.02)
ROUGH = 6e-4  # [m]


def record(way, *, rough=ROUGH):
    noise = rough * np.random.default_rng(7).standard_normal(TIME.size)
    position = 0.16 + way + noise
    position[0] = 0.16
    run = Run("quasistatic-forward", TIME, TIME, position, np.gradient(way, TIME))
    (only,) = make_run_records(Log((run,), units="meters"))
    return only


def lifted(sunk):
    """(n,) [m] that sinks in the first second, waits, and is lifted by 6 m."""
    sinks = -sunk * np.clip(TIME, 0.0, 1.0)
    return sinks + np.where(TIME > 1.5, 6.0 * np.clip((TIME - 1.5) / 2.5, 0.0, 1.0) ** 2, 0.0)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_what_stays_where_it_began_lies_on_its_stop_there(way):
    found = record(way * lifted(0.0))

    assert (found.low if way > 0.0 else found.high) == 0.16
    assert math.isinf(found.high if way > 0.0 else found.low)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_what_first_sinks_a_little_finds_its_stop_there(way):
    found = record(way * lifted(0.05))

    stop = found.low if way > 0.0 else found.high
    assert stop == pytest.approx(0.16 - way * 0.05, abs=5.0 * ROUGH)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_what_sinks_far_lies_on_nothing(way):
    found = record(way * lifted(0.3))

    assert math.isinf(found.low)
    assert math.isinf(found.high)


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize(("beyond", "stops"), [(0.02, False), (0.0, True)])
def test_a_place_that_it_later_passes_is_no_stop(way, beyond, stops):
    there = 3.0 * np.sin(np.clip((TIME - 0.5) / 2.5, 0.0, 1.0) * np.pi)
    found = record(way * (there - beyond * np.clip(TIME - 3.0, 0.0, 1.0)))

    assert math.isfinite(found.low if way > 0.0 else found.high) == stops
