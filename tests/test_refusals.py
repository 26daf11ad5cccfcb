"""Requests to the library that make no sense: each is refused in one line that says what to do."""

import math
from dataclasses import replace

import numpy as np
import pytest
from old_tools import read_json, sysid
from test_gap import NOISE, runs_of

import sim
from sim.bench.mechanisms import MECHANISMS, find_mechanism
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.errors import Refusal
from sim.core.log import Log, Run
from sim.feedback import Feedback, Plant, simulate_step_response
from sim.fit import fit
from sim.gap import map_gap
from sim.inspect.contaminate import contaminate, parse_fault_request
from sim.inspect.faults import find_fault
from sim.physics.motors import find_motor
from sim.teaching.profile_loop import TrapezoidProfile

GAINS = {"kS": 0.15, "kV": 2.5, "kA": 0.19}


def respond(loop="velocity", kp=1.0, **gains):
    plant = Plant("simple", GAINS | gains)
    return simulate_step_response(plant, loop=loop, feedback=Feedback(kp, 0.0), target=1.0)


def map_gap_of_nothing():
    (run,) = runs_of("dynamic-forward")
    return map_gap([replace(run, error=np.full_like(run.error, math.nan))], noise=NOISE)


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
def test_request_that_makes_no_sense_is_refused_in_one_line(request_):
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
