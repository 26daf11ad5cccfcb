"""A share of the battery is not a voltage: what reaches the motors, and what a fit makes of it."""

from dataclasses import replace

import numpy as np
import pytest

import sim
from sim.bench.duty_cycle import Battery, simulate_duty_cycle
from sim.core.errors import BadRequest

DRIVE = sim.MECHANISMS["drivetrain"]
ROUTINE = sim.Routine(ramp=0.5, step=3.5)
TIRED = Battery(rest=12.2, resistance=0.035)


def driven(battery, *, mechanism=DRIVE, routine=ROUTINE, seed=2):
    return simulate_duty_cycle(mechanism, routine, battery=battery, rng=np.random.default_rng(seed))


def test_a_step_from_rest_sags_by_ohms_law():
    # Four motors of 12 V/366 A at 3.5/12 of the battery, at rest: 0.035 Ω in series with
    # 12/366/4 Ω/(3.5/12)² seen from the battery.
    step = driven(TIRED).list_runs_of_test("dynamic-forward")[0]
    seen = 12.0 / 366.0 / 4.0 / (3.5 / 12.0) ** 2
    assert step.bus_voltage[0] == pytest.approx(12.2 * seen / (seen + 0.035), rel=1e-6)
    assert step.voltage[0] == pytest.approx(step.bus_voltage[0] * 3.5 / 12.0, rel=1e-6)


@pytest.mark.parametrize("name", sim.MECHANISMS)
@pytest.mark.parametrize("battery", [Battery(), TIRED, Battery(9.0, 0.1)], ids=str)
def test_power_out_of_the_battery_is_power_into_the_motors(name, battery):
    mechanism = sim.MECHANISMS[name]
    quiet = replace(mechanism, sensor=replace(mechanism.sensor, velocity_noise=0.0))
    motor = mechanism.motor
    for run in driven(battery, mechanism=quiet).runs:
        back_emf = motor.back_emf * mechanism.ratio / mechanism.radius * run.velocity
        current = (run.voltage - back_emf) / motor.resistance * mechanism.motor_count
        drawn = (battery.rest - run.bus_voltage) / battery.resistance
        assert run.bus_voltage * drawn == pytest.approx(run.voltage * current, abs=1e-2)


def test_a_brownout_that_a_real_robot_would_have_is_a_doubt():
    assert driven(TIRED).doubts == ()
    (doubt,) = driven(TIRED, routine=sim.Routine(step=7.0)).doubts
    assert doubt.code == "brownout"
    assert "Use a smaller step" in doubt.message


@pytest.mark.parametrize(
    ("rest", "resistance"), [(5.0, 0.02), (20.0, 0.02), (12.0, -0.1), (12.0, 1.0), (np.nan, 0.02)]
)
def test_no_battery_a_robot_would_start_with_is_refused(rest, resistance):
    with pytest.raises(BadRequest, match="A good one has 12.6 V"):
        Battery(rest, resistance)
