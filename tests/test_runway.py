"""A test on a floor with a tape on it: who lets go when, and where it stands."""

from dataclasses import replace

import numpy as np
import pytest

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.core.errors import BadRequest
from sim.physics.battery import Battery
from sim.teaching.runway import PERIOD, Floor, drive_test

ROBOT = replace(MECHANISMS["drivetrain"], travel=None)
TIRED = replace(ROBOT, battery=Battery(rest=11.6, resistance=0.035))
SLOW = sim.Routine(ramp=1.0, step=3.5, timeout=10.0)
RAMP, STEP = "quasistatic-forward", "dynamic-forward"


def gone(test, **floor):
    """A test of a good robot on a floor."""
    return drive_test(ROBOT, SLOW, test=test, floor=Floor(**floor))


def test_a_slow_ramp_goes_as_far_as_the_formula_says():
    """With kS 0.15 V, kV 2.52 V·s/m, kA/kV 76 ms: 0.5·(9.7 - 0.076)²/(2·2.52)."""
    went = drive_test(ROBOT, sim.Routine(ramp=0.5), test=RAMP, floor=Floor(wall=50.0))
    off = int(np.argmax(went.time >= went.released - PERIOD / 2))

    assert went.released == pytest.approx(10.0)
    assert went.position[off] == pytest.approx(0.5 * 9.624**2 / (2 * 2.524), rel=0.02)


def test_motors_stop_one_reaction_time_after_the_tape():
    went = gone(RAMP, wall=12.0, tape=7.0, thumb=0.3)
    passed = went.time[np.argmax(went.position >= 7.0)]

    assert went.released - passed == pytest.approx(0.3)
    assert 7.0 < went.final_position < 12.0
    assert went.hit_wall is None


def test_braking_keeps_to_what_the_carpet_holds():
    went = gone(RAMP, wall=12.0, tape=7.0)
    slows = -np.diff(went.velocity) / PERIOD

    assert slows.max() == pytest.approx(1.1 * 9.81, rel=0.01)


def test_a_robot_on_slippery_ground_goes_further():
    carpet, tiles = (
        gone(RAMP, wall=12.0, tape=7.0, grip=grip).final_position for grip in (1.1, 0.4)
    )
    speed = gone(RAMP, wall=12.0, tape=7.0).velocity.max()

    assert tiles - carpet == pytest.approx(
        speed**2 / (2 * 9.81) * (1 / 0.4 - 1 / 1.1), abs=0.1 * speed
    )


def test_robot_without_a_tape_drives_into_the_wall():
    went = gone(RAMP, wall=12.0)

    assert went.hit_wall == pytest.approx(went.time[-1])
    assert went.final_position == 12.0
    assert went.released == pytest.approx(10.0)


def test_test_ends_when_the_watching_time_is_over():
    assert gone(STEP, wall=9.0, watched=1.5).released == pytest.approx(1.5)


def test_a_tired_battery_browns_out_in_a_step_and_not_in_a_ramp():
    step, ramp = (
        drive_test(TIRED, SLOW, test=test, floor=Floor(wall=12.0, tape=7.0))
        for test in (STEP, RAMP)
    )

    assert step.battery.min() < TIRED.brownout < ramp.battery.min()
    assert step.final_position < 0.5 * gone(STEP, wall=12.0, tape=7.0).final_position


@pytest.mark.parametrize("wrong", [{"wall": 0.0}, {"wall": 9.0, "tape": -1.0}], ids=str)
def test_length_of_zero_or_less_is_refused(wrong, reads):
    with pytest.raises(BadRequest) as refused:
        Floor(**wrong)
    reads(refused.value)


def test_a_reverse_test_is_refused(reads):
    with pytest.raises(BadRequest) as refused:
        gone("dynamic-reverse", wall=9.0)
    reads(refused.value)


def test_braking_distance_is_at_least_that_of_the_carpet_grip():
    went = gone(RAMP, wall=12.0, tape=7.0)
    off = int(np.argmax(went.time >= went.released - PERIOD / 2))
    speed = went.velocity[off]

    assert speed == went.velocity.max()
    assert went.final_position - went.position[off] > 0.97 * speed**2 / (2 * 1.1 * 9.81)
