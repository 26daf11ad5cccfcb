"""Two bodies: exact where nothing happens, and closed in where a body turns or teeth meet."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from sim.physics.engine import NO_CORRECTION, RunBatch, State, filter_runs, simulate_run
from sim.physics.engine.two_body_modes import (
    MOVES,
    ROW,
    TABLES_SIZE,
    apply_row,
    make_table,
    make_table_from_half,
    prepare_series,
)
from sim.physics.model import Model, Part

FINE = 2e-5  # [s] steps of what the others are compared with
TIME = np.arange(0.0, 3.0, 0.02)
VOLTAGES = {
    "a ramp": 0.8 * TIME,
    "a step and its end": np.where(TIME < 1.5, 6.0, 0.0),
    "there and back": np.where(TIME % 1.0 < 0.5, 4.0, -4.0),
    "a slow wave": 3.0 * np.sin(2.0 * TIME),
}
BODIES = {
    "heavy": {"kS": 0.2, "kV": 2.0, "kA": 0.3},
    "light": {"kS": 0.1, "kV": 0.12, "kA": 0.01},
}
SHARES = (0.05, 0.8)


def sprung(gains, *, swing, share):
    reduced = share * (1.0 - share) * gains["kA"]
    soft = 1.0 / (reduced * (2.0 * math.pi * swing) ** 2)
    joint = {"softness": soft, "share": share, "damping": 0.05, "motor_friction": share}
    return Model("simple", gains) + Part("compliance", joint)


def loose(gains, *, moment, share):
    slack = moment * 4.0 / gains["kV"]
    joint = {"slack": slack, "share": share, "damping": 0.3, "motor_friction": share}
    return Model("simple", gains) + Part("backlash", joint)


def searched(model, volts):
    still = np.zeros(1)
    course = RunBatch(
        edges=np.array([0.0, TIME.size]), time=TIME, voltage=volts,
        voltage_slide=np.zeros(TIME.size),
        measured=np.full((TIME.size, 2), np.nan), position=still, velocity=still,
        low=still - math.inf, high=still + math.inf, clocks=still, memory_groups=still,
    )  # fmt: skip
    return filter_runs(
        model,
        course,
        kalman_gain=NO_CORRECTION,
        position_offset=still,
        backlash_phase=still,
        friction_offset=still,
        lag_offset=still,
    )


@given(
    dt=st.floats(1e-5, 0.02),
    kv=st.floats(0.0, 20.0),
    bodies=st.tuples(st.floats(1e-4, 2.0), st.floats(1e-4, 2.0)),
    swing=st.floats(0.5, 60.0),
    damping=st.floats(0.0, 1.0),
)
def test_the_tables_are_the_matrix_exponential(dt, kv, bodies, swing, damping):
    own, other = bodies
    reduced = own * other / (own + other)
    stiff = reduced * (2.0 * math.pi * swing) ** 2
    damp = 2.0 * damping * math.sqrt(stiff * reduced)
    tables = np.zeros(TABLES_SIZE)

    prepare_series(tables, MOVES, kv, own, other, stiff, damp)

    flow = np.zeros((6, 6))  # of d, v, w, y, b, r
    flow[0, 1:3] = 1.0, -1.0
    flow[1, [0, 1, 2, 4]] = -stiff / own, -(damp + kv) / own, damp / own, 1.0 / own
    flow[2, [0, 1, 2, 5]] = stiff / other, damp / other, -damp / other, 1.0 / other
    flow[3, 2] = 1.0
    for level in range(4):
        right = expm(flow * dt / 2**level)[:4][:, [0, 1, 2, 4, 5]]
        for make in (make_table_from_half, make_table):
            made = numbers(tables, make(tables, MOVES, dt, level))
            assert made == pytest.approx(right, rel=1e-6, abs=1e-8 * np.abs(right).max())


def numbers(tables, at):
    return tables[at : at + 4 * ROW].reshape(4, ROW)


@pytest.mark.parametrize("share", SHARES)
@pytest.mark.parametrize("swing", [2.0, 8.0, 30.0])
@pytest.mark.parametrize("volts", VOLTAGES)
@pytest.mark.parametrize("body", BODIES)
def test_exact_steps_of_a_spring_agree_with_steps_a_thousand_times_finer(body, volts, swing, share):
    model, asked = sprung(BODIES[body], swing=swing, share=share), VOLTAGES[volts]

    right = simulate_run(model, time=TIME, voltage=asked, state=State(), step=FINE)

    made = simulate_run(model, time=TIME, voltage=asked, state=State())
    quick = searched(model, asked)
    top, way = np.abs(right.velocity).max(), np.ptp(right.position)
    assert made.velocity == pytest.approx(right.velocity, abs=5e-4 * top)
    assert quick[:, 1] == pytest.approx(right.velocity, abs=3e-3 * top)
    assert quick[:, 0] == pytest.approx(right.position, abs=5e-4 * way)


@pytest.mark.parametrize("share", SHARES)
@pytest.mark.parametrize("moment", [0.0005, 0.002, 0.01, 0.04])
@pytest.mark.parametrize("volts", VOLTAGES)
@pytest.mark.parametrize("body", BODIES)
def test_gear_teeth_meet_and_part_at_the_same_times_in_finer_steps(body, volts, moment, share):
    model, asked = loose(BODIES[body], moment=moment, share=share), VOLTAGES[volts]

    right = simulate_run(model, time=TIME, voltage=asked, state=State(), step=FINE)

    quick = searched(model, asked)
    top, way = np.abs(right.velocity).max(), np.ptp(right.position)
    assert quick[:, 1] == pytest.approx(right.velocity, abs=3e-3 * top)
    assert quick[:, 0] == pytest.approx(right.position, abs=2e-4 * way)


@pytest.mark.parametrize("part", ["compliance", "backlash"])
def test_load_leaves_its_stop_at_the_same_time_in_finer_steps(part):
    gains = {**BODIES["heavy"], "kG": 0.9}
    other = sprung if part == "compliance" else loose
    size = {"swing": 6.0} if part == "compliance" else {"moment": 0.004}
    model = Model("elevator", gains, other(gains, share=0.3, **size).parts, travel=(0.0, 9.0))
    asked = VOLTAGES["a ramp"]

    right = simulate_run(model, time=TIME, voltage=asked, state=State(), step=FINE)

    quick = searched(model, asked)
    top = np.abs(right.velocity).max()
    assert right.load_position[asked < 0.9].max() == 0.0 < right.load_position[-1]
    assert quick[:, 1] == pytest.approx(right.velocity, abs=3e-3 * top)


@pytest.mark.parametrize("damping", [0.02, 0.13, 0.4])
def test_a_joint_overshoots_as_its_damping_says(damping):
    # The first overshoot of a damped oscillator after a step is exp(-πζ/√(1 - ζ²)) of its height.
    reduced = 0.25 * 0.3
    joint = {"softness": 1.0 / (reduced * (2.0 * math.pi * 4.0) ** 2), "share": 0.5}
    part = Part("compliance", {**joint, "damping": damping, "motor_friction": 0.5})
    model = Model("simple", {"kS": 0.0, "kV": 1e-6, "kA": 0.3}) + part
    state, bent = State(), []
    for _ in range(2000):
        moment = np.array([0.0, 0.0005])
        simulate_run(model, time=moment, voltage=np.ones(2), state=state, step=0.0005)
        bent.append(float(state.body[0] - state.body[2]))

    height = 0.5 * joint["softness"]  # half of the volt moves the load
    overshoot = math.exp(-math.pi * damping / math.sqrt(1.0 - damping**2))
    assert max(bent) == pytest.approx((1.0 + overshoot) * height, rel=0.01)


def test_table_row_moves_a_body_by_a_constant_force():
    tables = np.zeros(TABLES_SIZE)
    prepare_series(tables, MOVES, 0.0, 0.1, 0.2, 50.0, 0.0)
    at = make_table_from_half(tables, MOVES, 0.01, 0)

    fallen = apply_row(tables, at + 2 * ROW, 0.0, 0.0, 0.0, 0.0, -0.3)

    assert fallen == pytest.approx(-0.01 * 0.3 / 0.2, rel=0.01)
