"""The regression alone, on the data of SysId's own unit tests."""

import math

import numpy as np
import pytest

from sim.core.errors import NotIdentifiable
from sim.core.log import FOUR_TESTS
from sim.fit.regression import regress_acceleration
from sim.fit.sysid_rows import Rows

PERIOD = 0.005  # [s]
SAMPLES = 1000  # a test


def model_rows(*, ks, kv, ka, kg=0.0, offset=None):
    """The model of SysId's tests: zero-order hold, the sign of friction frozen over a step.

    Slow tests ramp at 0.25 V/s from 0; fast ones are 0 V in the first sample and 7 V after it. The
    acceleration is the model's own, not a difference.
    """
    rows = {}
    for test in FOUR_TESTS:
        sign = 1.0 if test.endswith("forward") else -1.0
        ramp = 0.25 * PERIOD * np.arange(SAMPLES)
        volts = sign * (ramp if test.startswith("quasi") else np.full(SAMPLES, 7.0))
        if test.startswith("dyn"):
            volts[0] = 0.0
        states = list(_states(volts, ks=ks, kv=kv, ka=ka, kg=kg, offset=offset))
        position, velocity, acceleration = np.array(states).T
        time = PERIOD * np.arange(SAMPLES)
        rows[test] = Rows(time, np.full(SAMPLES, PERIOD), volts, position, velocity, acceleration)
    return rows


def _states(volts, *, ks, kv, ka, kg, offset):
    x = v = 0.0

    def slope(x, v, u):
        pull = kg if offset is None else kg * math.cos(x + offset)
        return (u - ks * np.sign(v) - kv * v - pull) / ka

    for u in volts:
        yield x, v, slope(x, v, u)
        friction = ks * np.sign(v)
        if offset is None:
            decay = math.exp(-kv / ka * PERIOD)
            top = (u - friction - kg) / kv
            x, v = x + top * PERIOD + (v - top) * (1 - decay) * ka / kv, top + (v - top) * decay
        else:  # fine steps stand in for SysId's adaptive ones
            for _ in range(50):
                h = PERIOD / 50
                middle = (u - friction - kv * v - kg * math.cos(x + offset)) / ka
                xm, vm = x + 0.5 * h * v, v + 0.5 * h * middle
                x, v = (
                    x + h * vm,
                    v + h * (u - friction - kv * vm - kg * math.cos(xm + offset)) / ka,
                )


@pytest.mark.parametrize("offset", [-2.0, -1.0, 0.0, 1.0, 2.0])
@pytest.mark.parametrize(
    ("truth", "within"),
    [
        (dict(ks=1.01, kv=3.060, ka=0.327, kg=0.211), 3e-2),
        (dict(ks=0.547, kv=0.0693, ka=0.1170, kg=0.122), 5e-2),
    ],
    ids=["arm A", "arm B"],
)
def test_an_arm_is_found_with_its_angle(truth, within, offset):
    found = regress_acceleration(model_rows(**truth, offset=offset), type="arm")

    *gains, angle = found.gains.values()
    assert gains == pytest.approx(list(truth.values()), abs=8e-3)
    assert angle == pytest.approx(offset, abs=within)


def test_the_errors_cover_the_truth_of_noisy_accelerations():
    rows = model_rows(ks=0.3, kv=2.0, ka=0.2)
    truth = regress_acceleration(rows, type="simple").gains
    rng = np.random.default_rng(5)
    misses = []
    for _ in range(200):
        noisy = {
            test: Rows(
                part.time,
                part.period,
                part.voltage,
                part.position,
                part.velocity,
                part.acceleration + rng.normal(0, 2.0, SAMPLES),
            )
            for test, part in rows.items()
        }
        found = regress_acceleration(noisy, type="simple")
        misses.append([(found.gains[g] - truth[g]) / found.errors[g] for g in truth])

    spread = np.std(misses, axis=0)
    # a normalized miss has a spread of 1; 200 draws tell it to within 5 %, four of those allowed
    assert spread == pytest.approx([1.0, 1.0, 1.0], abs=0.2)


def test_tests_that_excite_nothing_are_refused_by_the_gain_they_leave_open():
    rows = model_rows(ks=0.3, kv=2.0, ka=0.2)
    still = {
        test: Rows(
            part.time,
            part.period,
            part.voltage,
            part.position,
            part.voltage / 2.0,  # speed always half of the voltage: the two cannot be told apart
            part.acceleration,
        )
        for test, part in rows.items()
    }

    with pytest.raises(
        NotIdentifiable, match="cannot separate k. from the other gains. Move at two"
    ):
        regress_acceleration(still, type="simple")
