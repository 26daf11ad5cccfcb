"""The residual microscope, and bars of gaps."""

from dataclasses import replace

import numpy as np
import pytest
from html_tags import Tags

import sim
from sim.bench.duty_cycle import Battery, simulate_duty_cycle
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest
from sim.physics.model import Model
from sim.plot import make_residual_views, plot_gap_bars, plot_voltage_residual
from sim.plot.voltage_residual import compute_missing_volts, simulate_velocity

DRIVETRAIN = MECHANISMS["drivetrain"]
TRUTH = Model("simple", DRIVETRAIN.gains)
ROUTINE = sim.Routine(
    ramp=1.0, step=3.5, timeout=3.0, kinds=("quasistatic", "dynamic", "multistep")
)
TIRED = Battery(rest=12.2, resistance=0.035)
HIDES = {  # what is hidden -> the side from which it is seen best
    "cogging": "position",
    "velocity-filter": "time since the voltage jumped",
    "asymmetric-friction": "direction",
    "drag": "speed",
}


def hiding(effect, *, noise=True):
    robot = DRIVETRAIN.hide(effect) if effect else DRIVETRAIN
    if not noise:
        robot = replace(robot, sensor=replace(robot.sensor, velocity_noise=0.0))
    return simulate(robot, ROUTINE, rng=np.random.default_rng(1), electrical=True)


@pytest.mark.parametrize("effect", HIDES)
def test_each_effect_is_seen_best_from_its_own_side(effect):
    log = hiding(effect)
    found = make_residual_views(log, TRUTH)
    assert found.clearest == HIDES[effect]
    assert found.unexplained < 0.3


def test_a_battery_that_gives_way_is_seen_best_over_its_voltage():
    hard = replace(ROUTINE, step=5.0)
    log = simulate_duty_cycle(DRIVETRAIN, hard, battery=TIRED, rng=np.random.default_rng(1))
    asked = replace(
        log, runs=tuple(replace(r, voltage=12.0 * r.voltage / r.bus_voltage) for r in log.runs)
    )
    found = make_residual_views(asked, TRUTH)
    assert found.clearest == "battery voltage"
    lowest = found.views["battery voltage"].mean
    assert lowest[np.isfinite(lowest)][0] < -0.2  # [V] the robot got less than the log says


def test_nothing_is_seen_where_nothing_is_missing():
    log = hiding("")
    found = make_residual_views(log, TRUTH)
    assert found.is_noise
    assert found.headline == "At least 90 % of this is noise."
    assert all(view.explains < 0.1 for view in found.views.values())


def test_missing_volts_are_the_volts_of_the_friction_that_is_hidden():
    log = hiding("asymmetric-friction", noise=False)
    (lean,) = DRIVETRAIN.hide("asymmetric-friction").hidden[0].parameters.values()
    ramp = log.list_runs_of_test("quasistatic-forward")[0]
    lacks = compute_missing_volts(log, simulate_velocity(log, TRUTH), TRUTH.gains)[
        log.runs.index(ramp)
    ]
    fast = np.flatnonzero(ramp.velocity > 0.3)[:-1]
    assert np.median(lacks[fast]) == pytest.approx(-lean, rel=0.05)


@pytest.mark.parametrize("gaps", [{}, {"a": {}}, {"a": {"log": 1.0}, "b": {"other": 1.0}}])
def test_gaps_of_different_logs_are_refused(gaps):
    with pytest.raises(BadRequest, match="a gap for each log"):
        plot_gap_bars(gaps)


def test_each_picture_has_words_and_a_table():
    log = hiding("drag")
    for picture in (
        plot_voltage_residual(log, TRUTH),
        plot_gap_bars({"a": {"log": 2.0}}),
    ):
        (image,) = Tags(picture.html).all("img")
        assert image["alt"] == picture.alt
        assert len(picture.alt) > 40
        assert picture.table.rows
