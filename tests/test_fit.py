"""Method sysid: SysId's own figures, its silent failures spoken aloud, and the metrics it shows."""

import json
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from known_answers import NAMES, known_answer

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import BadRequest, NotIdentifiable
from sim.core.log import FOUR_TESTS
from sim.fit import fit as any_fit

fit = partial(any_fit, method="sysid")

FIGURES = {
    "accel_R2_adj": "acceleration_r2",
    "accel_RMSE": "acceleration_rmse",
    "sim_velocity_R2": "simulated_velocity_r2",
    "sim_velocity_RMSE": "simulated_velocity_rmse",
    "velocity_threshold": "velocity_threshold",
    "step_test_duration_s": "step_duration",
}


@pytest.fixture
def drive():
    return simulate(
        MECHANISMS["drivetrain"], Routine(ramp=0.5, step=3.5), rng=np.random.default_rng(1)
    )


def change(log, test, **signals):
    """The log with some signals of one test replaced."""
    return replace(
        log,
        runs=tuple(replace(run, **signals) if run.test == test else run for run in log.runs),
    )


@pytest.mark.parametrize("name", NAMES)
def test_every_gain_and_metric_equals_that_of_sysid(name):
    known = known_answer(name)
    answer = known.answer

    found = fit(known.log, type=known.type, median=known.median).in_log_units()

    for gain, value in found.gains.items():
        assert value == pytest.approx(answer[gain], rel=1e-10), gain
    assert dict(found.samples_used) == answer["samples_used"]
    for theirs, ours in FIGURES.items():
        if theirs.startswith("sim_") and known.type == "arm":
            continue  # SysId's arm simulation stops at a tolerance of 0.25: no figure to copy
        assert getattr(found, ours) == pytest.approx(answer[theirs], rel=1e-9), ours
    assert found.position_delay * 1e3 == pytest.approx(answer["position_delay_ms"], abs=1e-9)
    assert found.velocity_delay * 1e3 == pytest.approx(answer["velocity_delay_ms"], abs=1e-9)
    assert found.feedback()["velocity"].kp == pytest.approx(answer["feedback"]["kP"], rel=1e-10)


def test_the_json_has_the_keys_other_programs_read(drive):
    data = json.loads(json.dumps(fit(drive).in_log_units().to_json(), allow_nan=False))

    assert list(data) == [
        "type",
        "method",
        "units",
        "gains",
        "errors",
        "acceleration_r2",
        "acceleration_rmse",
        "simulated_velocity_r2",
        "simulated_velocity_rmse",
        "samples_used",
        "feedback",
        "warnings",
        "small_effects",
    ]
    assert set(data["feedback"]) == {"velocity", "position"}
    assert set(data["feedback"]["velocity"]) == {"kP", "kD"}
    assert set(data["samples_used"]) == set(FOUR_TESTS)


def test_times_in_milliseconds_are_refused_where_sysid_says_nan(drive):
    runs = tuple(replace(run, time=run.time * 1000) for run in drive.runs)

    with pytest.raises(NotIdentifiable, match=r"20 s apart.*milliseconds: divide them by 1000"):
        fit(replace(drive, runs=runs))


def test_an_arm_in_meters_is_refused_where_sysid_says_nan(drive):
    with pytest.raises(BadRequest, match="must be an angle, and this log is in meters"):
        fit(drive, type="arm")


def test_repeated_runs_are_reported_as_ignored(drive):
    twice = replace(drive, runs=drive.runs + drive.runs[:1])

    found = fit(twice)

    assert found.gains == fit(drive).gains
    (doubt,) = found.doubts
    assert doubt.code == "repeated-test"
    assert "quasistatic-forward (2 runs)" in doubt.message


@pytest.mark.parametrize(("held", "of_its_size"), [(3, 0.67), (4, 0.50), (5, 0.40)])
def test_a_velocity_logged_faster_than_it_is_sent_is_doubted_by_what_it_costs(held, of_its_size):
    truth = MECHANISMS["shooter"]  # slow enough that a few held samples delay nothing
    log = simulate(truth, Routine(ramp=0.5, step=3.5), rng=np.random.default_rng(1))
    stale = [np.repeat(run.velocity[::held], held)[: len(run)] for run in log.runs]
    runs = tuple(replace(run, velocity=v) for run, v in zip(log.runs, stale, strict=True))

    found = fit(replace(log, runs=runs))

    (doubt,) = [doubt for doubt in found.doubts if doubt.code == "stale-velocity"]
    said = int(doubt.message.partition("kA becomes about ")[2].partition("%")[0]) / 100
    assert said == pytest.approx(of_its_size, abs=0.06)
    assert found.gains["kA"] / truth.gains["kA"] == pytest.approx(said, abs=0.08)


@pytest.mark.parametrize(
    ("signals", "said"),
    [
        (
            lambda run: {"velocity": 0 * run.velocity},
            "never changes. Check that the velocity is read from the encoder",
        ),
        (
            lambda run: {"voltage": 0 * run.voltage},
            "never moves.*Check that the encoder is read, the motor was enabled",
        ),
    ],
    ids=["encoder not read", "voltage not logged"],
)
def test_a_ramp_without_motion_says_what_to_check(drive, signals, said):
    with pytest.raises(NotIdentifiable, match=said):
        fit(
            change(
                drive,
                "quasistatic-forward",
                **signals(drive.list_runs_of_test("quasistatic-forward")[0]),
            )
        )


def test_a_log_that_says_its_type_needs_no_option():
    log = known_answer("elevator-noisy-20ms").log

    assert "kG" in fit(replace(log, type="elevator")).gains
    assert "kG" not in fit(log).gains


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (dict(type="spring"), "unknown type 'spring'. Choose one of: simple, elevator, arm"),
        (dict(method="guess"), "unknown method 'guess'. Choose one of: output-error, sysid"),
        (dict(median=16), "a median window of 16 samples is not possible. Choose 1"),
    ],
    ids=lambda value: str(value)[:20],
)
def test_unknown_option_value_lists_the_known_ones(drive, asked, said):
    with pytest.raises(BadRequest) as refused:
        fit(drive, **asked)

    assert said in str(refused.value)
