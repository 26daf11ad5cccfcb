"""Feedback gains as WPILib's SysId suggests them, and the response of a loop."""

import math
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.linalg import expm, fractional_matrix_power, solve_discrete_are

from sim.core.errors import BadRequest
from sim.feedback import (
    PRESETS,
    Feedback,
    Plant,
    design_position_loop,
    design_velocity_loop,
    judge_step_response,
    simulate_step_response,
)
from sim.feedback.linear_quadratic import design_two_state_regulator
from sim.fit import Fit
from sim.fit.feedback_trial import (
    OWN,
    SUGGESTED,
    OwnGains,
    try_feedback_gains,
    warn_of_bad_suggestions,
)
from sim.physics.engine import State, simulate_run
from sim.physics.model import Model

ALLOWED = {"velocity_error": 1.5, "volts": 7.0}  # SysId's test settings


@pytest.mark.parametrize(
    ("preset", "kv", "ka", "kp"),
    [
        ("default", 3.060, 0.327, 2.10943242457),
        ("default", 0.0693, 0.1170, 3.11253582864),
        ("default", 3.060, 0.0, 0.0),
        ("ctre-phoenix5", 1.97, 0.179, 259.212767315),
        ("rev-brushless", 1.97, 0.179, 0.000178155039061),
        ("ctre-phoenix6", 1.97, 0.179, 2.96668263259),
        ("rev-brushed", 1.97, 0.179, 0.000422308190478),
        ("venom", 1.97, 0.179, 15.0709394559),
    ],
)
def test_velocity_loop_has_the_gains_of_sysid(preset, kv, ka, kp):
    gains = design_velocity_loop(kv=kv, ka=ka, preset=PRESETS[preset], **ALLOWED)

    assert gains.kp == pytest.approx(kp, rel=1e-10)
    assert gains.kd == 0.0


@pytest.mark.parametrize(
    ("preset", "ka", "delay", "kp", "kd"),
    [
        ("default", 0.327, None, 6.40639032759, 2.47675154504),
        ("default", 1e-10, None, 19.9730148702, 0.0),
        ("default", 0.327, 0.010, 5.91707817018, 2.12056137442),
        ("rev-brushless", 0.327, None, 0.302021438601, 48.5176534816),
    ],
)
def test_position_loop_has_the_gains_of_sysid(preset, ka, delay, kp, kd):
    gains = design_position_loop(
        kv=3.060, ka=ka, preset=PRESETS[preset], position_error=1.0, delay=delay, **ALLOWED
    )

    assert (gains.kp, gains.kd) == pytest.approx((kp, kd), rel=1e-10)


@given(kv=st.floats(0.01, 20.0), ka=st.floats(1e-4, 5.0), error=st.floats(0.1, 10.0))
def test_allowing_a_larger_error_never_raises_kp(kv, ka, error):
    strict = design_velocity_loop(kv=kv, ka=ka, velocity_error=error)
    loose = design_velocity_loop(kv=kv, ka=ka, velocity_error=2 * error)

    assert 0.0 <= loose.kp <= strict.kp


@given(kv=st.floats(0.01, 20.0), ka=st.floats(1e-4, 5.0), delay=st.floats(0.0, 0.2))
def test_a_delay_never_raises_kp(kv, ka, delay):
    assert (
        design_velocity_loop(kv=kv, ka=ka, delay=delay).kp <= design_velocity_loop(kv=kv, ka=ka).kp
    )


@pytest.mark.parametrize(("kv", "ka"), [(-1.0, 0.1), (1.0, -0.1), (float("nan"), 0.1)])
def test_gains_no_motor_has_are_refused(kv, ka):
    with pytest.raises(BadRequest, match="does a positive voltage give a positive velocity"):
        design_velocity_loop(kv=kv, ka=ka)


def test_an_allowed_error_of_zero_is_refused():
    with pytest.raises(BadRequest, match="Give numbers above zero"):
        design_position_loop(kv=1.0, ka=0.1, position_error=0.0)


VOLTS, POSITION = 7.0, 0.1


def by_scipy(rate, push, *, period, q, r, loops):
    discrete = expm(np.array([[0.0, 1.0, 0.0], [0.0, rate, push], [0.0, 0.0, 0.0]]) * period)
    a, b = discrete[:2, :2], discrete[:2, 2:]
    s = solve_discrete_are(a, b, np.diag(q), np.array([[r]]))
    k = np.linalg.solve(b.T @ s @ b + r, b.T @ s @ a)
    return np.real(k @ fractional_matrix_power(a - b @ k, loops))[0] if loops else k[0]


@pytest.mark.parametrize("period", [0.001, 0.020])
@pytest.mark.parametrize("delay", [0.0, 0.001, 0.0815, 0.112])
@pytest.mark.parametrize(
    ("kv", "ka"),
    [(2.0, 0.3), (0.12, 0.01), (35.0, 0.2), (0.0, 0.5), (0.02, 0.1), (1.3, 0.003), (0.5, 40.0)],
)
def test_gains_are_those_of_scipy(kv, ka, period, delay):
    q = (POSITION**-2, (0.25 * 12.0 / kv if kv else 1.5) ** -2)
    asked = {"period": period, "q": q, "r": VOLTS**-2, "loops": delay / period}

    found = design_two_state_regulator(-kv / ka, 1.0 / ka, **asked)

    expected = by_scipy(-kv / ka, 1.0 / ka, **asked)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_a_fit_in_json_imports_no_scipy(tmp_path):
    code = (
        "import sys, numpy as np, sim\n"
        "from sim.bench.mechanisms import MECHANISMS\n"
        "from sim.bench.simulate import simulate\n"
        "log = simulate(MECHANISMS['drivetrain'], sim.Routine(), rng=np.random.default_rng(1))\n"
        "sim.write(log, sys.argv[1])\n"
        "from sim.cli import sysid\n"
        "from sim.support.command_line import run_command\n"
        "code = run_command(sysid, name='sysid', arguments=['fit', '--json', sys.argv[1]])\n"
        "assert code == 0 and not [name for name in sys.modules if name.startswith('scipy')]\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "a.wpilog")],
        capture_output=True, text=True, check=False,
    )  # fmt: skip

    assert done.returncode == 0, done.stderr


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


def test_negative_suggestion_comes_with_gains_that_settle():
    # 112 ms after the voltage the REV's loop has turned round: K (A - BK)^112 is negative
    (doubt,) = doubts(found(LIGHT), "rev-brushless")

    assert doubt.code == "unsettled-feedback"
    assert doubt.message.startswith("Start the position loop with kP ")
    assert "in simulation with 112 ms of delay" in doubt.message
    assert "for REV brushless port" in doubt.message
    kp, kd = map(float, re.findall(r"loop with kP (\S+) .*?, kD (\S+) .*?: ", doubt.message)[0])
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


def test_the_learners_own_gains_are_tried_and_reported_without_a_warning():
    tried = try_feedback_gains(
        found(), PRESETS["default"], own=OwnGains("position", Feedback(600.0, 0.0))
    )

    (own,) = [one for one in tried if one.owner == OWN]
    (suggested,) = [one for one in tried if one.owner == SUGGESTED and one.loop == "position"]
    assert own.response.target == suggested.response.target
    assert own.verdict.kind == "oscillates"
    assert warn_of_bad_suggestions(found(), tried) == ()


def test_gains_are_designed_for_the_measured_delay_with_the_default_preset_only():
    late = found(velocity_delay=0.14, position_delay=0.02)

    assert late.choose_feedback_delay(PRESETS["default"], loop="velocity") == 0.14
    assert late.choose_feedback_delay(PRESETS["default"], loop="position") == 0.02
    assert late.choose_feedback_delay(PRESETS["venom"], loop="velocity") == 5e-3


def test_gains_of_a_motor_controller_are_simulated_with_the_delay_of_the_log():
    tried = try_feedback_gains(found(velocity_delay=0.14), PRESETS["venom"])

    delays = {one.loop: one.delay for one in tried}
    assert delays == {"velocity": 0.14, "position": PRESETS["venom"].delay}


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


GAINS = {"kS": 0.15, "kV": 2.5, "kA": 0.19}
PLANTS = {
    "simple": Plant("simple", GAINS),
    "elevator": Plant("elevator", GAINS | {"kG": 0.8}),
    "arm": Plant("arm", GAINS | {"kG": 0.6, "offset_rad": -0.4}),
}
QUICK = replace(PRESETS["ctre-phoenix6"], delay=0.0)  # 1 ms, volts: nearly continuous


@pytest.mark.parametrize("loop", ["velocity", "position"])
@pytest.mark.parametrize("kind", PLANTS)
def test_the_mechanism_moves_as_in_the_engine(kind, loop):
    plant = PLANTS[kind]
    gains = Feedback(3.0, 0.0) if loop == "velocity" else Feedback(50.0, 4.0)
    took = simulate_step_response(
        plant, loop=loop, feedback=gains, target=plant.choose_target_step(loop), delay=0.01
    )

    track = simulate_run(
        Model(kind, plant.gains),
        time=np.array(took.time),
        voltage=np.array([*took.voltage[1:], 0.0]),  # each until the next
        state=State.cold_at(plant.level_position),
        step=1e-4,
    )

    told = track.velocity if loop == "velocity" else track.position - plant.level_position
    assert np.array(took.value) == pytest.approx(told, abs=2e-3 * took.target)


def test_velocity_without_friction_and_delay_follows_the_closed_form():
    # kV·v + kA·v' = kV·r + kP·(r - v), so the error dies with kA/(kV + kP)
    plant = Plant("simple", {"kS": 0.0, "kV": 1.0, "kA": 0.5})
    took = simulate_step_response(
        plant, loop="velocity", feedback=Feedback(4.0, 0.0), target=1.0, preset=QUICK
    )

    tenth = took.time.index(pytest.approx(0.1))

    assert took.value[tenth] == pytest.approx(1.0 - math.exp(-1.0), rel=0.01)


@pytest.mark.parametrize(("share", "kind"), [(0.4, "settles"), (0.7, "rings"), (1.3, "oscillates")])
def test_delayed_loop_oscillates_above_the_gain_of_the_closed_form(share, kind):
    # an integrator 1/kA behind a delay T swings at kP = π/2·kA/T; T has half a period on top
    ka, wait = 0.1, 0.1
    plant = Plant("simple", {"kS": 0.0, "kV": 1e-6, "kA": ka})
    most = 0.5 * math.pi * ka / (wait + 0.5 * QUICK.period)

    took = simulate_step_response(
        plant, loop="velocity", feedback=Feedback(share * most, 0.0), target=1.0,
        preset=QUICK, delay=wait, seconds=10.0,
    )  # fmt: skip

    assert judge_step_response(took).kind == kind


@pytest.mark.parametrize("name", PRESETS)
@pytest.mark.parametrize("loop", ["velocity", "position"])
def test_a_presets_units_cancel(name, loop):
    # the same physical loop, counted as this controller counts
    preset = PRESETS[name]
    plain = replace(preset, output=1.0, velocity_time=1.0, normalized=True)
    counts = preset.velocity_time if loop == "velocity" else 1.0
    scale = preset.output / counts
    written = Feedback(3.0 * scale, 0.2 * scale / (1.0 if preset.normalized else preset.period))
    asked = {"loop": loop, "target": 0.4, "delay": 0.0}

    here = simulate_step_response(PLANTS["simple"], feedback=written, preset=preset, **asked)
    there = simulate_step_response(
        PLANTS["simple"], feedback=Feedback(3.0, 0.2), preset=plain, **asked
    )

    assert here.value == pytest.approx(there.value)


def test_a_position_loop_too_weak_for_friction_stops_short_by_what_friction_holds():
    # it stands where kP·error = kS: 0.15 V / 2 V/m = 75 mm short, 15 % of the step
    weak = Feedback(2.0, 0.0)
    took = simulate_step_response(
        PLANTS["simple"], loop="position", feedback=weak, target=0.5, seconds=10.0
    )

    told = judge_step_response(took)

    assert told.kind == "stays-short"
    assert told.left == pytest.approx(0.15, abs=0.01)
    assert told.description == "stops 15% of the step before the target"


@settings(max_examples=60)
@given(
    kp=st.floats(-1e6, 1e6),
    kd=st.floats(-1e4, 1e4),
    delay=st.floats(0.0, 0.3),
    kv=st.floats(0.0, 50.0),
    ka=st.floats(1e-4, 5.0),
)
def test_any_gains_give_finite_numbers_and_a_sentence(kp, kd, delay, kv, ka):
    plant = Plant("simple", {"kS": 0.1, "kV": kv, "kA": ka})
    took = simulate_step_response(
        plant, loop="position", feedback=Feedback(kp, kd), target=0.3, delay=delay, seconds=1.0
    )

    assert all(map(math.isfinite, took.value))
    assert "nan" not in judge_step_response(took).description
