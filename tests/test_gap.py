"""The gap between simulation and measurement, and what it refuses."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from old_tools import read_json, sysid

import sim
from sim.bench.mechanisms import MECHANISMS, find_mechanism
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import Refusal
from sim.core.log import DIRECTIONS, Log, Run
from sim.feedback import Feedback, Plant, simulate_step_response
from sim.fit import fit
from sim.gap import Residuals, find_gap_places
from sim.inspect.contaminate import contaminate, parse_fault_request
from sim.inspect.faults import find_fault
from sim.physics.motors import find_motor
from sim.teaching.profile_loop import TrapezoidProfile

NOISE = 0.01
PERIOD, KS, KV = 0.02, 0.2, 2.0
FOUR = [f"{kind}-{way}" for kind in ("quasistatic", "dynamic") for way in DIRECTIONS]


def expected(test):
    """Voltage and motion without inertia: a ramp of 0.5 V/s, or 4 V after half a second."""
    since = PERIOD * np.arange(400)
    volts = 0.5 * since if test.startswith("quasistatic") else np.where(since < 0.5, 0.0, 4.0)
    volts = volts if test.endswith("forward") else -volts
    speed = np.sign(volts) * np.maximum(np.abs(volts) - KS, 0.0) / KV
    return since, volts, np.column_stack([PERIOD * np.cumsum(speed), speed])


def run_of(test, *, rng, plant=None, start=0.0):
    """A run of which the model leaves noise and, in noises of a velocity, what is planted."""
    since, volts, motion = expected(test)
    missed = rng.normal(size=since.size) * NOISE
    if plant:
        at = SimpleNamespace(t=since, u=volts, x=motion[:, 0], v=motion[:, 1])
        missed += NOISE * plant(at)
    return Residuals(test, start + since, volts, motion, missed)


def runs_of(*tests, seed=0, plant=None):
    rng = np.random.default_rng(seed)
    return [run_of(test, rng=rng, plant=plant) for test in tests or FOUR]


def since_jump(at):
    return np.where(np.abs(at.u) == 4.0, at.t - at.t[np.argmax(np.abs(at.u) > 2.0)], np.nan)


@pytest.mark.parametrize(
    ("plant", "what", "where", "sign"),
    [
        (
            lambda at: 3.0 * ((at.t > 4.0) & (at.t < 5.4) & (at.u > 0.0) & (at.u < 4.0)),
            "run", "quasistatic-forward (1), 4.0 to", 1.0,
        ),
        (
            lambda at: -4.0 * ((at.v > 0.48) & (at.v < 0.71)),
            "direction-speed", "forward, 25 to 37% of the top speed", -1.0,
        ),
        (
            lambda at: -4.0 * ((at.x < -4.8) & (at.x > -7.1)),
            "direction-position", "reverse, 25 to 33% of the way", 1.0,
        ),
        (
            lambda at: -6.0 * np.sign(at.u) * (since_jump(at) < 0.19),
            "after-steps", "0.00 to 0.20 s after the voltage jumps up", -1.0,
        ),
        (
            lambda at: 3.0 * ((at.v == 0.0) & (at.u > 0.0)),
            "at-rest", "at rest under forward voltage, ", 1.0,
        ),
    ],
    ids=["run and time", "direction and speed", "direction and position", "after steps", "at rest"],
)  # fmt: skip
def test_an_error_of_the_model_is_found_in_its_bin(plant, what, where, sign):
    found = find_gap_places(runs_of(*FOUR, *FOUR, plant=plant), noise=NOISE, most=10)

    mine = [place for place in found if place.what == what]
    assert any(place.where.startswith(where) for place in mine), found
    assert {np.sign(place.error) for place in mine} == {sign}


def test_pure_noise_has_no_significant_residual():
    # 300 cells beyond 4 standard errors: about one log of fifty
    alarms = [bool(find_gap_places(runs_of(seed=seed), noise=NOISE)) for seed in range(60)]

    assert sum(alarms) <= 4


def test_binning_by_noisy_measurements_would_show_a_false_gap():
    rng = np.random.default_rng(3)
    still = Residuals(
        "coast-forward", PERIOD * np.arange(400), np.zeros(400), np.zeros((400, 2)),
        rng.normal(size=400) * NOISE,
    )  # fmt: skip
    moving = runs_of("quasistatic-forward", seed=4)[0]
    slow = replace(moving, predicted=moving.predicted * 0.02)  # as slow as the noise is large
    mistaken = [
        replace(r, predicted=np.column_stack([r.predicted[:, 0], r.predicted[:, 1] + r.error]))
        for r in (still, slow)
    ]

    fooled = find_gap_places(mistaken, noise=NOISE)

    assert find_gap_places([still, slow], noise=NOISE) == ()
    assert max(place.sure for place in fooled) > 10.0


@pytest.mark.parametrize("unit", [0.0254, 100.0], ids=["inches", "a hundredth"])
def test_the_places_do_not_depend_on_the_unit(unit):
    runs = runs_of(plant=lambda at: 3.0 * (at.v > 0.5))
    scaled = [replace(r, predicted=r.predicted / unit, error=r.error / unit) for r in runs]

    mine = find_gap_places(runs, noise=NOISE)
    other = find_gap_places(scaled, noise=NOISE / unit)

    assert [place.where for place in mine] == [place.where for place in other]
    assert [place.error for place in mine] == pytest.approx([place.error for place in other])


GAINS = {"kS": 0.15, "kV": 2.5, "kA": 0.19}


def respond(loop="velocity", kp=1.0, **gains):
    plant = Plant("simple", GAINS | gains)
    return simulate_step_response(plant, loop=loop, feedback=Feedback(kp, 0.0), target=1.0)


def map_gap_of_nothing():
    (run,) = runs_of("dynamic-forward")
    return find_gap_places([replace(run, error=np.full_like(run.error, math.nan))], noise=NOISE)


def spoil_an_elevator():
    rng = np.random.default_rng(1)
    log = simulate(MECHANISMS["elevator"], Routine(timeout=2.0), rng=rng)
    return contaminate(log, "wheel-slip", rng=rng)


REQUESTS = {
    "an unknown mechanism": lambda: find_mechanism("trebuchet"),
    "an unknown motor": lambda: find_motor("hamster"),
    "an unknown fault": lambda: find_fault("gremlin"),
    "a log of no known type": lambda: Log((), type="crane"),
    "a run of no known test": lambda: Run("static", [], [], [], []),
    "no test at all": lambda: Routine(kinds=()),
    "a test twice": lambda: Routine(kinds=("coast", "coast")),
    "slip and a joint": lambda: MECHANISMS["drivetrain"].hide("wheel-slip").hide("backlash"),
    "wheels of an elevator": spoil_an_elevator,
    "a gap of nothing": map_gap_of_nothing,
    "a profile to nowhere": lambda: TrapezoidProfile(0.5, 0.5, 1.0, 1.0),
    "a profile without speed": lambda: TrapezoidProfile(0.0, 1.0, 0.0, 1.0),
    "an unknown loop": lambda: respond(loop="torque"),
    "a gain that is no number": lambda: respond(kp=math.nan),
    "a plant that cannot be": lambda: respond(kA=-0.1),
    "a fit of nothing": lambda: fit(Log(()), type="simple"),
}


@pytest.mark.parametrize("request_", REQUESTS.values(), ids=REQUESTS)
def test_invalid_request_is_refused_in_one_line(request_):
    with pytest.raises(Refusal) as refused:
        request_()

    assert "\n" not in str(refused.value)
    assert refused.value.advice.endswith(".")


@pytest.mark.parametrize("asked", [{"motor": "middle"}, {"entries": {"voltage": "volts"}}])
def test_request_that_a_file_cannot_meet_is_refused(tmp_path, asked):
    with pytest.raises(Refusal) as refused:
        read_json(tmp_path, sysid(9, "Drivetrain"), **asked)

    assert refused.value.advice


@pytest.mark.parametrize("runs", [(), (Run("dynamic-forward", [], [], [], []),)], ids=len)
def test_log_that_rows_cannot_hold_is_not_written(tmp_path, runs):
    with pytest.raises(Refusal):
        sim.write(Log(runs), tmp_path / "log.csv")

    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("text", ["", ":2", "brownout:lots", "brownout@", "brownout@+3"])
def test_misspelled_fault_is_refused_with_the_right_spelling(text):
    with pytest.raises(Refusal) as refused:
        parse_fault_request(text)

    assert "encoder-slip:0.5@dynamic-forward+0.4" in str(refused.value)
