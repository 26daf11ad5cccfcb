"""Feedback gains on trial: what SysId suggests is not handed over where it does not settle."""

import re
from dataclasses import replace

from hypothesis import assume, given, settings
from hypothesis import strategies as st

from sim.feedback import PRESETS, Feedback, Plant, judge_step_response, simulate_step_response
from sim.fit import Fit
from sim.fit.feedback_trial import (
    OWN,
    SUGGESTED,
    OwnGains,
    choose_feedback_delay,
    try_feedback_gains,
    warn_of_bad_suggestions,
)

DRIVE = {"kS": 0.15, "kV": 2.5, "kA": 0.19}
LIGHT = {"kS": 0.05, "kV": 0.12, "kA": 0.032}  # a flywheel [per rotation]: 270 ms, no load


def found(gains=DRIVE, **changes):
    fit = Fit(
        type="simple",
        method="output-error",
        units="meters",
        log_units="meters",
        gains=gains,
        errors=dict.fromkeys(gains, 0.001),
        acceleration_r2=0.9,
        acceleration_rmse=0.1,
        simulated_velocity_r2=0.99,
        simulated_velocity_rmse=0.01,
        samples_used={},
        position_delay=0.0,
        velocity_delay=0.0,
        velocity_threshold=0.0,
        step_duration=1.0,
    )
    return replace(fit, **changes)


def doubts(fit, preset="default"):
    return warn_of_bad_suggestions(fit, try_feedback_gains(fit, PRESETS[preset]))


def test_a_suggestion_that_turns_the_wrong_way_comes_with_one_that_settles():
    # 112 ms after the voltage the REV's loop has turned round: K (A - BK)^112 is negative
    (doubt,) = doubts(found(LIGHT), "rev-brushless")

    assert doubt.code == "unsettled-feedback"
    assert doubt.message.startswith("Start the position loop with kP ")
    assert "in simulation with 112 ms of delay" in doubt.message
    assert "for REV brushless port" in doubt.message
    kp, kd = map(float, re.findall(r"loop with kP (\S+), kD (\S+): ", doubt.message)[0])
    plant = Plant("simple", LIGHT)
    took = simulate_step_response(
        plant,
        loop="position",
        feedback=Feedback(kp, kd),
        target=plant.choose_target_step("position"),
        preset=PRESETS["rev-brushless"],
    )
    assert kp > 0.0
    assert judge_step_response(took).is_good


def test_the_learners_own_gains_are_tried_and_told_but_not_doubted():
    tried = try_feedback_gains(
        found(), PRESETS["default"], own=OwnGains("position", Feedback(600.0, 0.0))
    )

    (own,) = [one for one in tried if one.owner == OWN]
    (suggested,) = [one for one in tried if one.owner == SUGGESTED and one.loop == "position"]
    assert own.response.target == suggested.response.target
    assert own.verdict.kind == "oscillates"
    assert warn_of_bad_suggestions(found(), tried) == ()


def test_the_logs_delay_is_the_default_presets_and_no_others():
    late = found(velocity_delay=0.14, position_delay=0.02)

    assert choose_feedback_delay(late, PRESETS["default"], loop="velocity") == 0.14
    assert choose_feedback_delay(late, PRESETS["default"], loop="position") == 0.02
    assert choose_feedback_delay(late, PRESETS["venom"], loop="velocity") == 5e-3


@settings(max_examples=30)  # each tries up to ten loops
@given(
    kv=st.floats(0.02, 20.0),
    timescale=st.floats(0.01, 1.0),
    preset=st.sampled_from(list(PRESETS)),
)
def test_a_negative_gain_is_never_handed_over_in_silence(kv, timescale, preset):
    fit = found({"kS": 0.1, "kV": kv, "kA": timescale * kv})
    tried = try_feedback_gains(fit, PRESETS[preset])
    assume(tried)

    said = " ".join(doubt.message for doubt in warn_of_bad_suggestions(fit, tried))

    for one in tried:
        if min(one.gains.kp, one.gains.kd) < 0.0 or not one.verdict.is_good:
            assert f"the {one.loop} loop" in said
