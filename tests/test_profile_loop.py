"""A profile in closed loop: WPILib's arithmetic, a known answer, and a learner's own loop."""

import math
from dataclasses import replace
from itertools import pairwise
from operator import attrgetter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.bench.mechanisms import MECHANISMS
from sim.core.errors import BadRequest
from sim.teaching.profile_loop import (
    LOOP,
    RIGHT,
    ElevatorFeedforward,
    PIDController,
    TrapezoidProfile,
    check_loop,
    compute_loop_voltage,
    follow_in_closed_loop,
)

LIFT = MECHANISMS["elevator"]
SMOOTH = replace(LIFT, friction=0.0)
RISE = TrapezoidProfile(start=0.1, goal=1.1, max_velocity=1.2, max_acceleration=6.0)
# Every leg lasts whole loops of 20 ms: 0.2 s, 0.6 s, 0.2 s.
ROUND = TrapezoidProfile(start=0.1, goal=1.06, max_velocity=1.2, max_acceleration=6.0)


def error(gains, *, robot=LIFT, kp=0.0, profile=RISE):
    """[cm] the worst error of a move with these gains."""
    ff = ElevatorFeedforward(*(gains[name] for name in ("kS", "kG", "kV", "kA")))
    pid = PIDController(kp)
    move = follow_in_closed_loop(robot, profile, lambda one: compute_loop_voltage(ff, pid, one))
    return 100.0 * move.worst_error


def test_true_gains_without_hidden_effects_track_without_error():
    # In between, the speed under a constant voltage is no straight line: it is ahead of one by
    # a·T²/12·(kV/kA) on average, and a·t is the top speed when the first leg ends.
    bend = LOOP**2 / 12.0 * SMOOTH.gains["kV"] / SMOOTH.gains["kA"] * ROUND.max_velocity
    assert error(SMOOTH.gains, robot=SMOOTH, profile=ROUND) == pytest.approx(100 * bend, rel=0.01)
    assert error(LIFT.gains) < 0.2  # [cm] and from rest there is one loop without kS


@pytest.mark.parametrize(
    ("changes", "least"),
    [({"kG": 0.9}, 2.0), ({"kV": 1.1}, 5.0), ({"kA": 1.5}, 2.0), ({"kS": 0.0}, 3.0)],
)
def test_each_wrong_gain_increases_the_tracking_error_and_kp_reduces_it(changes, least):
    wrong = {name: value * changes.get(name, 1.0) for name, value in LIFT.gains.items()}
    alone, helped = error(wrong), error(wrong, kp=20.0)

    assert alone > least > 10.0 * error(LIFT.gains)
    assert helped < 0.7 * alone


def test_a_missing_kg_leaves_the_droop_that_the_arithmetic_says():
    kp = 20.0
    wrong = {**SMOOTH.gains, "kG": SMOOTH.gains["kG"] - 0.4}
    ff = ElevatorFeedforward(*(wrong[name] for name in ("kS", "kG", "kV", "kA")))
    slow = TrapezoidProfile(start=0.1, goal=0.3, max_velocity=0.1, max_acceleration=1.0)
    pid = PIDController(kp)
    move = follow_in_closed_loop(SMOOTH, slow, lambda one: compute_loop_voltage(ff, pid, one))

    assert move.error[-1] == pytest.approx(0.4 / kp, rel=0.03)  # missing kG ÷ kP


@given(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0), st.floats(0.1, 3.0), st.floats(0.2, 20.0))
def test_a_profile_keeps_its_limits_and_arrives(start, goal, speed, push):
    if abs(goal - start) < 1e-3:
        return
    profile = TrapezoidProfile(start, goal, speed, push)
    times = [profile.duration * k / 200 for k in range(201)]
    points = [profile.calculate(t) for t in times]
    step = profile.duration / 200

    assert points[0].position == pytest.approx(start)
    assert points[-1].position == pytest.approx(goal)
    assert points[-1].velocity == pytest.approx(0.0)
    for before, after in pairwise(points):
        assert abs(after.velocity) <= speed * (1 + 1e-9)
        assert abs(after.velocity - before.velocity) <= push * step * (1 + 1e-6) + 1e-9
        way = 0.5 * step * (before.velocity + after.velocity)
        assert after.position - before.position == pytest.approx(way, abs=push * step**2)


@given(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0))
def test_the_feedforward_is_wpilibs(now, after):
    wpi = pytest.importorskip("wpimath.controller", reason="needs the extra robot")
    for gains in ((0.25, 2.0, 4.5, 0.2), (0.1, 0.0, 2.5, 0.0)):
        theirs = wpi.ElevatorFeedforward(*gains).calculate(now, after)

        assert ElevatorFeedforward(*gains).calculateWithVelocities(now, after) == pytest.approx(
            theirs, rel=1e-9, abs=1e-9
        )


def test_from_rest_the_first_loop_has_no_ks():
    ff, bare = (ElevatorFeedforward(ks, 2.0, 4.5, 0.2) for ks in (0.25, 0.0))

    assert ff.calculateWithVelocities(0.0, 0.1) == bare.calculateWithVelocities(0.0, 0.1)
    assert ff.calculateWithVelocities(0.1, 0.2) == pytest.approx(
        0.25 + bare.calculateWithVelocities(0.1, 0.2)
    )


def test_the_feedforward_has_the_name_that_python_gives_it():
    ff = ElevatorFeedforward(0.25, 2.0, 4.5, 0.2)

    assert ff.calculate(0.1, 0.2) == ff.calculateWithVelocities(0.1, 0.2)


def test_the_feedback_is_wpilibs():
    wpi = pytest.importorskip("wpimath.controller", reason="needs the extra robot")
    mine, theirs = PIDController(3.0, 0.7, 0.05), wpi.PIDController(3.0, 0.7, 0.05)
    for loop in range(200):
        measured, wanted = math.sin(0.1 * loop), 1.0 + 0.01 * loop

        assert mine.calculate(measured, wanted) == pytest.approx(theirs.calculate(measured, wanted))


def make_loop(
    now="now.velocity", after="after.velocity", measured="position", wanted="now.position"
):
    """A learner's loop that hands these numbers of a moment to the feedforward and the feedback."""
    of = attrgetter(now, after, measured, wanted)

    def loop(ff, pid, one):
        velocity, later, seen, asked = of(one)
        return ff.calculateWithVelocities(velocity, later) + pid.calculate(seen, asked)

    return loop


@pytest.mark.parametrize(
    ("mine", "says"),
    [
        (compute_loop_voltage, RIGHT),
        (make_loop(), RIGHT),
        (lambda *_: ..., "still empty"),
        (lambda *_: nothing, "stops with an error"),  # noqa: F821 - meant
        (lambda ff, _, one: make_loop()(ff, PIDController(0.0), one), "The feedback adds nothing"),
        (lambda _, pid, one: pid.calculate(one.position, one.now.position), "The feedforward adds"),
        (make_loop(measured="now.position", wanted="position"), "takes the measurement first"),
        (make_loop(after="now.velocity"), "kA does nothing"),
        (make_loop(now="after.velocity", after="now.velocity"), "velocities are swapped"),
        (make_loop(wanted="after.position"), "not the next one"),
        (make_loop(now="now.position", after="after.position"), "needs velocities"),
        (make_loop(now="velocity"), "never at what is measured"),
        (make_loop(measured="velocity", wanted="now.velocity"), "controls a position"),
        (lambda *_: 1.0, "Add two things"),
    ],
)
def test_wrong_loop_of_a_learner_is_replaced_by_the_right_one(mine, says):
    found = check_loop(mine)

    assert says in " ".join(found.report.split())
    assert max(map(len, found.report.splitlines())) <= 80
    assert found.loop is (mine if says is RIGHT else compute_loop_voltage)


@pytest.mark.parametrize("volts", [lambda _: math.nan, lambda _: ..., lambda _: "12"])
def test_a_loop_that_returns_no_number_is_refused(volts):
    with pytest.raises(BadRequest, match="instead of volts"):
        follow_in_closed_loop(LIFT, RISE, volts)
