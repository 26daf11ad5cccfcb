"""A loop's step response: against the engine, against paper, and in words."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.feedback import (
    PRESETS,
    Feedback,
    Plant,
    judge_step_response,
    simulate_step_response,
)
from sim.physics.engine import State, simulate_run
from sim.physics.model import Model

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


def test_without_friction_and_delay_a_velocity_follows_the_exponential_of_paper():
    # kV·v + kA·v' = kV·r + kP·(r - v), so the error dies with kA/(kV + kP)
    plant = Plant("simple", {"kS": 0.0, "kV": 1.0, "kA": 0.5})
    took = simulate_step_response(
        plant, loop="velocity", feedback=Feedback(4.0, 0.0), target=1.0, preset=QUICK
    )

    tenth = took.time.index(pytest.approx(0.1))

    assert took.value[tenth] == pytest.approx(1.0 - math.exp(-1.0), rel=0.01)


@pytest.mark.parametrize(("share", "kind"), [(0.4, "settles"), (0.7, "rings"), (1.3, "oscillates")])
def test_a_delay_makes_a_loop_swing_from_the_gain_of_paper_on(share, kind):
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
def test_whatever_the_gains_the_answer_is_numbers_and_a_sentence(kp, kd, delay, kv, ka):
    plant = Plant("simple", {"kS": 0.1, "kV": kv, "kA": ka})
    took = simulate_step_response(
        plant, loop="position", feedback=Feedback(kp, kd), target=0.3, delay=delay, seconds=1.0
    )

    assert all(map(math.isfinite, took.value))
    assert "nan" not in judge_step_response(took).description
