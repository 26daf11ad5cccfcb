"""kP and kD against the figures of SysId's own tests and of its core."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.core.errors import BadRequest
from sim.feedback import PRESETS, design_position_loop, design_velocity_loop

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
def test_a_velocity_loop_is_sysids_own(preset, kv, ka, kp):
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
def test_a_position_loop_is_sysids_own(preset, ka, delay, kp, kd):
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
