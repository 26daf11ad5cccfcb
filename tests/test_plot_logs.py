"""Pictures of a log and of its gap: damage, residuals, SysId's own plots, tables."""

from dataclasses import replace

import numpy as np
import pytest
from handmade import FOUR, log_of, run_of, with_gaps
from html_tags import Tags
from matplotlib.colors import same_color

import sim
from sim.bench.duty_cycle import Battery, simulate_duty_cycle
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest, NotIdentifiable
from sim.core.log import FOUR_TESTS, Log, Run
from sim.inspect.fault import Damage, LogInterval
from sim.physics.model import Model
from sim.plot import (
    Table,
    make_residual_views,
    plot_acceleration_velocity,
    plot_gap_bars,
    plot_time_series,
    plot_voltage_residual,
    plot_voltage_velocity,
)
from sim.plot.picture import COLORS
from sim.plot.table import to_text
from sim.plot.voltage_residual import compute_missing_volts, simulate_velocity


def _damage(fault, run, test="", start=0.0, end=0.0):
    where = LogInterval(run, test, start, end)
    return Damage(where, 0.9, "seen", "Run it again.", fault=fault)


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
def test_damage_that_no_panel_shows_is_in_the_alt_text(damage):
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


def find_clearest(found):
    """The variable that explains the largest share of the residual."""
    return max(found.views, key=lambda name: found.views[name].explains)


@pytest.mark.parametrize("effect", HIDES)
def test_each_effect_is_clearest_over_its_own_variable(effect):
    log = hiding(effect)
    found = make_residual_views(log, TRUTH)
    assert find_clearest(found) == HIDES[effect]
    assert found.unexplained < 0.3


def test_battery_sag_is_clearest_over_the_voltage():
    hard = replace(ROUTINE, step=5.0)
    log = simulate_duty_cycle(DRIVETRAIN, hard, battery=TIRED, rng=np.random.default_rng(1))
    asked = replace(
        log, runs=tuple(replace(r, voltage=12.0 * r.voltage / r.bus_voltage) for r in log.runs)
    )
    found = make_residual_views(asked, TRUTH)
    assert find_clearest(found) == "battery voltage"
    lowest = found.views["battery voltage"].mean
    assert lowest[np.isfinite(lowest)][0] < -0.2  # [V] the robot got less than the log says


def test_complete_model_shows_no_structure_in_its_residual():
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


PERIOD, STEP = 0.02, 0.0005  # [s] between samples, and between two steps of the motion
KS, KV, KA = 0.2, 2.0, 0.3


def _swing():
    """Four tests of a mechanism with these gains, in small steps."""
    runs = []
    for number, test in enumerate(FOUR_TESTS):
        sign = 1.0 if test.endswith("forward") else -1.0
        x = v = 0.0
        rows = []
        for sample in range(150):
            volts = sign * (1.2 * PERIOD * (sample + 1) if test.startswith("quasi") else 3.0)
            rows.append((4.0 * number + PERIOD * sample, volts, x, v))
            for _ in range(round(PERIOD / STEP)):
                if v == 0.0 and abs(volts) <= KS:
                    continue
                v += STEP * (volts - sign * KS - KV * v) / KA
                x += STEP * v
        runs.append(sim.Run(test, *np.array(rows).T))
    return Log(tuple(runs))


def test_a_step_falls_on_the_line_of_its_gains():
    picture = plot_acceleration_velocity(_swing())
    step = next(row for row in picture.table.rows if row[0] == "dynamic-forward")
    # under 3 V: (3.0 - 0.2)/0.3 at standstill, falling by kV/kA per second
    assert step[4] == pytest.approx(2.8 / 0.3, rel=0.05)
    assert step[5] == pytest.approx(-2.0 / 0.3, rel=0.05)
    assert len(picture.figure.axes[0].lines) == 4


@pytest.mark.parametrize(
    "log",
    [Log(()), replace(FOUR, runs=FOUR.runs[:3]), log_of(*FOUR_TESTS, seconds=0.02)],
    ids=["empty", "a test is missing", "one sample each"],
)
def test_log_that_sysid_cannot_use_is_refused(log):
    with pytest.raises(NotIdentifiable):
        plot_acceleration_velocity(log)


@pytest.mark.parametrize(
    ("cell", "text"),
    [
        (0.15, "0.150"),
        (2.52384, "2.52"),
        (-0.0921, "−0.0921"),
        (27.01, "27.0"),
        (499, "499"),
        (-3, "−3"),
        (12345.6, "12346"),
        (1.5e7, "1.5e+07"),
        (0.0, "0"),
        (float("inf"), "inf"),
        ("kS", "kS"),
    ],
)
def test_a_cell_has_three_digits(cell, text):
    assert to_text(cell) == text


def test_a_table_names_its_rows_and_columns_for_a_screen_reader():
    tags = Tags(Table(("gain", "value"), (("kS", 0.15), ("<kV>", 2.5)), caption="A & B").html)
    assert [attrs["scope"] for attrs in tags.all("th")] == ["col", "col", "row", "row"]
    html = Table(("gain",), (("<kV>",),), caption="A & B").html
    assert "&lt;kV&gt;" in html
    assert "A &amp; B" in html
