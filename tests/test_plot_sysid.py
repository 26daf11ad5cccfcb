"""SysId's own pictures: the rows it uses, and its quantities, worked out from its source."""

from dataclasses import replace

import numpy as np
import pytest
from handmade import FOUR, log_of

import sim
from sim.core.errors import BadRequest, NotIdentifiable
from sim.core.log import FOUR_TESTS, Log
from sim.fit.sysid_rows import prepare_rows
from sim.plot import plot_acceleration_velocity, plot_velocity_time

PERIOD, STEP = 0.02, 0.0005  # [s] between samples, and between two steps of the motion
SIMPLE = {"kS": 0.2, "kV": 2.0, "kA": 0.3}
ELEVATOR = SIMPLE | {"kG": 0.7}
ARM = SIMPLE | {"kG": 0.7, "offset_rad": 0.4}


def _swing(gains, *, type="simple", units="meters"):  # noqa: A002 - the log's word
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
                lean = np.cos(x + gains.get("offset_rad", 0.0)) if type == "arm" else 1.0
                push = volts - gains.get("kG", 0.0) * lean
                way = np.sign(v) or np.sign(push)
                if v == 0.0 and abs(push) <= gains["kS"]:
                    continue
                slope = (push - way * gains["kS"] - gains["kV"] * v) / gains["kA"]
                v = 0.0 if v * (v + STEP * slope) < 0.0 else v + STEP * slope
                x += STEP * v
        runs.append(sim.Run(test, *np.array(rows).T))
    return Log(tuple(runs), type=type, units=units)


CASES = {
    "simple": (SIMPLE, _swing(SIMPLE)),
    "elevator": (ELEVATOR, _swing(ELEVATOR, type="elevator")),
    "arm": (ARM, _swing(ARM, type="arm", units="degrees")),
}
each_type = pytest.mark.parametrize("kind", CASES)


@each_type
def test_with_the_true_gains_the_samples_lie_on_the_line(kind):
    gains, log = CASES[kind]
    scale = 180.0 / np.pi if kind == "arm" else 1.0
    for row in plot_acceleration_velocity(log, gains=gains).table.rows:
        # a central difference over 40 ms at a time constant of 150 ms, and half the true slope at
        # the first sample, are off by a tenth of the largest acceleration (3.0 V / 0.3) at most
        assert row[5] < 0.1 * 10.0 * scale


@pytest.mark.parametrize(
    ("kind", "wrong"), [(kind, gain) for kind, (gains, _) in CASES.items() for gain in gains]
)
def test_a_wrong_gain_takes_them_off_the_line(kind, wrong):
    gains, log = CASES[kind]
    right = plot_acceleration_velocity(log, gains=gains).table.rows
    other = plot_acceleration_velocity(log, gains=gains | {wrong: gains[wrong] + 0.3}).table.rows
    assert sum(row[5] for row in other) > 1.3 * sum(row[5] for row in right)


def test_the_quantity_is_that_of_sysids_source():
    log = CASES["simple"][1]
    rows = prepare_rows(log).rows["quasistatic-reverse"]
    # As in AnalyzerPlot.cpp: from the acceleration V/kA is taken off, sgn(v)·kS/kA is added.
    expected = rows.acceleration - rows.voltage / 0.3 + np.copysign(0.2 / 0.3, rows.velocity)
    drawn = plot_acceleration_velocity(log, gains=SIMPLE).figure.axes[0].lines[1]
    assert np.isin(np.round(drawn.get_ydata(), 9), np.round(expected, 9)).all()
    assert drawn.get_ydata().size > 100


def test_the_fit_is_a_line_through_the_origin_with_the_slope_of_the_gains(reads):
    picture = plot_acceleration_velocity(CASES["simple"][1], gains=SIMPLE)
    line = picture.figure.axes[0].lines[-1]
    x, y = line.get_xdata(), line.get_ydata()
    assert y == pytest.approx(-2.0 / 0.3 * x)
    reads(picture.alt)


def test_without_gains_it_is_the_acceleration_itself():
    log = CASES["simple"][1]
    picture = plot_acceleration_velocity(log)
    step = next(row for row in picture.table.rows if row[0] == "dynamic-forward")
    # under 3 V: (3.0 - 0.2)/0.3 at standstill, falling by kV/kA per second
    assert step[4] == pytest.approx(2.8 / 0.3, rel=0.05)
    assert step[5] == pytest.approx(-2.0 / 0.3, rel=0.05)
    assert len(picture.figure.axes[0].lines) == 4


def test_an_arm_in_degrees_shows_the_same_as_in_radians():
    _, log = CASES["arm"]
    degrees = plot_acceleration_velocity(log, gains=ARM).table.rows
    radians = plot_acceleration_velocity(replace(log, units="radians"), gains=ARM).table.rows
    for one, other in zip(degrees, radians, strict=True):
        assert np.radians(one[5]) == pytest.approx(other[5])


@pytest.mark.parametrize(
    ("gains", "said"),
    [
        ({"kS": 0.1, "kV": 2.0}, "gains without kA"),
        ({}, "gains without kS and kV and kA"),
        (SIMPLE | {"kA": 0.0}, "a kA of zero"),
        (SIMPLE | {"kV": float("nan")}, "not finite"),
    ],
    ids=["no kA", "none", "zero kA", "nan"],
)
def test_gains_that_make_no_line_are_refused(gains, said):
    with pytest.raises(BadRequest, match=f"{said}.*Give "):
        plot_acceleration_velocity(CASES["simple"][1], gains=gains)


@pytest.mark.parametrize(
    "draw", [plot_acceleration_velocity, plot_velocity_time], ids=lambda d: d.__name__
)
@pytest.mark.parametrize(
    "log",
    [Log(()), replace(FOUR, runs=FOUR.runs[:3]), log_of(*FOUR_TESTS, seconds=0.02)],
    ids=["empty", "a test is missing", "one sample each"],
)
def test_what_sysid_cannot_use_is_refused(draw, log):
    with pytest.raises(NotIdentifiable):
        draw(log)


def test_what_the_fit_uses_is_counted_and_drawn_where_it_is():
    log = CASES["simple"][1]
    picture, rows = plot_velocity_time(log), prepare_rows(log).rows
    for axes, test in zip(
        picture.figure.axes,
        ("quasistatic-forward", "dynamic-forward", "quasistatic-reverse", "dynamic-reverse"),
        strict=True,
    ):
        used = next(line for line in axes.lines if line.get_label() == "used by the fit")
        start = log.list_runs_of_test(test)[0].time[0]
        assert used.get_xdata() == pytest.approx(rows[test].time - start)
        assert axes.get_title() == f"{test}: {len(rows[test])} of 150 used"
        assert f"The fit uses {len(rows[test])} of the 150 samples of {test}" in picture.alt


def test_the_median_filter_shows_in_the_line_and_in_the_words(reads):
    log = CASES["simple"][1]
    spiked = log.runs[0].velocity.copy()
    spiked[100] += 5.0
    log = replace(log, runs=(replace(log.runs[0], velocity=spiked), *log.runs[1:]))
    raw, filtered = plot_velocity_time(log), plot_velocity_time(log, median=3)
    assert raw.table.rows[0][5] > 5.0 > filtered.table.rows[0][5]
    reads(filtered.alt)
    assert "smoother" not in raw.alt


def test_a_model_beside_is_drawn_and_its_miss_told(reads):
    log = CASES["simple"][1]
    slower = tuple(replace(run, velocity=run.velocity - 0.25) for run in log.runs)
    picture = plot_velocity_time(log, beside=replace(log, runs=slower), name="model")
    assert [row[6] for row in picture.table.rows] == pytest.approx([0.25] * 4)
    reads(picture.alt)
    assert all("model" in axes.get_legend_handles_labels()[1] for axes in picture.figure.axes)


def test_the_dynamic_tests_can_be_shown_in_part():
    picture = plot_velocity_time(CASES["simple"][1], dynamic_seconds=0.5)
    assert [axes.get_xlim()[1] == 0.5 for axes in picture.figure.axes] == [False, True] * 2
