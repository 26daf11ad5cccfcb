"""SysIdRoutine's tests and the others: which voltage, when."""

import math

import numpy as np
import pytest

from sim.bench.routine import Routine
from sim.core.errors import BadRequest
from sim.core.log import KINDS


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (dict(ramp=0.0), "a ramp of 0 V/s is out of range. Choose a number above 0"),
        (dict(ramp=math.nan), "a ramp of nan V/s"),
        (dict(step=-3.0), "a step of -3 V"),
        (dict(step=24.0), "at most 12 V"),
        (dict(timeout=math.inf), "a timeout of inf s"),
    ],
    ids=lambda value: str(value)[:20],
)
def test_a_routine_no_robot_can_run_is_refused(asked, said):
    with pytest.raises(BadRequest) as refused:
        Routine(**asked)

    assert said in str(refused.value)


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_test_stays_within_the_step_and_is_mirrored_in_reverse(kind):
    routine = Routine(ramp=0.35, step=3.5, timeout=10.0, kinds=(kind,))
    time = np.arange(0.04, 10.0, 0.02).tolist()

    there, back = ([routine.command_voltage(test, t) for t in time] for test in routine.tests)

    assert routine.tests == (f"{kind}-forward", f"{kind}-reverse")
    assert np.abs(there).max() == pytest.approx(3.5, rel=0.02)
    assert (np.array(there) == -np.array(back)).all()
