"""Elevators whose weight is not their inertia times g: a cascade, and one with a counterweight."""

import numpy as np
import pytest

from sim.bench.mechanisms import find_mechanism
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.fit import fit
from sim.physics.motors import find_motor

G = 9.81  # [m/s²]
GENTLE = Routine(ramp=1.0, step=4.0)
NEO = find_motor("neo")

# name, [kg] what the motors carry, [kg] what they accelerate, [m/s²] weight over inertia.
# Cascade: a carriage of 12 kg and a stage of 8 kg at half its speed: 12 + 8/2 and 12 + 8/4.
# Counterweight: 15 kg and 6 kg on the other end of the rope: 15 - 6 and 15 + 6.
ELEVATORS = [
    ("cascade-elevator", 16.0, 14.0, 11.21),
    ("counterweight-elevator", 9.0, 21.0, 4.20),
]


def recorded(name):
    return simulate(find_mechanism(name), GENTLE, rng=np.random.default_rng(4))


@pytest.mark.parametrize(("name", "weight", "inertia", "lift"), ELEVATORS)
def test_elevator_has_the_weight_and_inertia_of_its_stages(name, weight, inertia, lift):
    built = find_mechanism(name)
    radius = 2.0 * 0.0222 if name == "cascade-elevator" else 0.0222
    volts_per_newton = NEO.resistance * radius / (2 * NEO.torque_constant * built.ratio)

    assert built.gains["kG"] == pytest.approx(volts_per_newton * weight * G, rel=1e-9)
    assert built.gains["kA"] == pytest.approx(volts_per_newton * inertia, rel=1e-9)
    assert built.gains["kG"] / built.gains["kA"] == pytest.approx(lift, abs=0.01)


@pytest.mark.parametrize("name", [row[0] for row in ELEVATORS])
def test_a_fit_finds_its_gains(name):
    found = fit(recorded(name))

    for gain, true in find_mechanism(name).gains.items():
        assert found.gains[gain] == pytest.approx(true, rel=0.03), gain
    assert not [doubt for doubt in found.doubts if doubt.grave]
