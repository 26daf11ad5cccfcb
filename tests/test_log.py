"""The waist: what a Run and a Log promise to everybody on both sides of it."""

import math

import numpy as np
import pytest

from sim.core.errors import BadRequest, BadSample
from sim.core.log import Log, Run
from sim.core.units import UNITS, find_unit
from sim.io.format import make_run


def run(**changes):
    signals = {
        "test": "dynamic-forward",
        "time": [0.0, 0.02, 0.04],
        "voltage": [0.0, 7.0, 7.0],
        "position": [0.0, 0.0, 0.01],
        "velocity": [0.0, 0.0, 0.5],
    }
    return Run(**(signals | changes))


def test_arrays_of_a_run_cannot_be_changed():
    mine = np.array([0.0, 7.0, 7.0])
    made = run(voltage=mine)
    mine[0] = 12.0

    assert made.voltage[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        made.voltage[0] = 12.0


@pytest.mark.parametrize(
    "changes",
    [
        {"velocity": [0.0, math.nan, 0.5]},
        {"voltage": [0.0, math.inf, 7.0]},
        {"position": [0.0, 1e12, 0.0]},
        {"position": [0.0, 1.0]},
        {"time": [0.0, 0.02, 0.02]},
        {"current": [1.0]},
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_invalid_measurement_is_refused_with_its_place(changes):
    with pytest.raises(BadSample) as refused:
        run(**changes)

    assert refused.value.advice
    assert str(refused.value).startswith("dynamic-forward: ")


def test_two_logs_join_unless_one_is_an_angle():
    meters = Log((run(),), source="a.csv")
    turned = Log((run(),), units="degrees", source="b.csv")

    assert len(meters.join(Log((run(),), units="feet")).runs) == 2
    with pytest.raises(BadRequest) as refused:
        meters.join(turned)
    assert refused.value.advice


def test_raw_columns_become_si_and_repeated_times_are_reported():
    signals = {
        "time": np.array([0.0, 0.02, 0.02, 0.04]),
        "voltage": np.ones(4),
        "position": np.array([0.0, 0.5, 0.5, 1.0]),
        "velocity": np.array([0.0, 1.0, 9.0, 2.0]),
    }

    made, doubts = make_run("coast-forward", signals, si=2.0, where="x.csv")

    assert made.velocity.tolist() == [0.0, 2.0, 4.0]
    assert made.position.tolist() == [0.0, 1.0, 2.0]
    assert [doubt.code for doubt in doubts] == ["repeated-time"]


def test_raw_columns_are_refused_with_file_run_and_time():
    signals = dict.fromkeys(("time", "voltage", "position"), np.arange(3.0))

    with pytest.raises(BadSample) as refused:
        make_run(
            "coast-forward",
            signals | {"velocity": np.array([0, 1, math.nan])},
            si=1.0,
            where="x.csv",
        )

    assert refused.value.advice


@pytest.mark.parametrize(
    ("name", "si"),
    [("feet", 0.3048), ("inches", 0.0254), ("rotations", 2 * math.pi), ("degrees", math.pi / 180)],
)
def test_units_have_their_si_values(name, si):
    assert UNITS[name].si == pytest.approx(si, rel=1e-15)
    assert find_unit(f" {name.upper()} ") is UNITS[name]


# -- a voltage that slides between samples -------------------------------------------------------


def stepped(voltage, test="dynamic-forward"):
    count = len(voltage)
    return Run(test, np.arange(count) * 0.02, voltage, [0.0] * count, [0.0] * count)


def test_under_a_limit_the_voltage_slides_after_the_step():
    run = stepped([0.0, 3.9, 4.4, 4.8, 5.0, 5.0])

    assert run.voltage_slide == pytest.approx([0.0, 0.5, 0.4, 0.2, 0.0, 0.0])
    assert run.voltage_error[1:4] == pytest.approx([0.5 / 8, 0.3 / 8, 0.4 / 8])


@pytest.mark.parametrize("test", ["quasistatic-forward", "triangle-forward", "chirp-reverse"])
def test_a_voltage_that_changes_every_loop_is_held_between_samples(test):
    assert not stepped([0.0, 0.5, 1.0, 1.5], test).voltage_slide.any()
