"""An encoder that slips is told from a push: no push changes a speed within a sample."""

import numpy as np
import pytest

from sim.core.log import Log, Run
from sim.estimation.likelihood import PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import make_run_records
from sim.inspect.fault import rescale_motion
from sim.physics.engine import State, simulate_run
from sim.physics.model import Model
from sim.reconcile.slip_detection import SHARP_SLOW, detect_slips

PERIOD = 0.02  # [s]
NOISE = (1e-4, 0.01)  # [m] and [m/s]
STEP, RAMP = 6.0, 1.0  # [V] and [V/s]
BASE = ModelStructure("simple")
LIGHT = 1.05 * SHARP_SLOW * PERIOD  # [s] the shortest time scale that is asked
HEAVY = 0.3  # [s]


def gains(scale):
    return {"kS": 0.3, "kV": 2.0, "kA": 2.0 * scale}


def recorded(test, scale, rng, *, lost=(), lasts=1.0):
    """A run whose motor did not get a share of the voltage that was logged, at some times."""
    quick = test.startswith("dynamic")
    time = np.arange(0.0, lasts if quick else 7.0, PERIOD)
    sign = -1.0 if test.endswith("reverse") else 1.0
    volts = sign * (np.where(time < 2 * PERIOD, 0.0, STEP) if quick else RAMP * time)
    real = volts.copy()
    for start, end, share in lost:
        real[(time >= start) & (time < end)] *= 1.0 - share
    track = simulate_run(
        Model("simple", gains(scale)), time=time, voltage=real, state=State.cold_at(0.0)
    )
    seen = (
        one + size * rng.standard_normal(time.size)
        for one, size in zip((track.position, track.velocity), NOISE, strict=True)
    )
    return Run(test, time, volts, *seen)


def slips(scale, *, test="quasistatic-forward", lost=(), reads=(), lasts=1.0):
    """The slips found in four runs, of which one lost voltage, or was read at another pace."""
    rng = np.random.default_rng(5)
    runs, clock = [], 0.0
    for kind in ("quasistatic", "dynamic"):
        for way in ("forward", "reverse"):
            name = f"{kind}-{way}"
            run = recorded(name, scale, rng, lost=lost if name == test else (), lasts=lasts)
            paces = np.ones(run.time.size)
            for start, end, pace in reads if name == test else ():
                paces[(run.time > start) & (run.time <= end)] = pace
            run = rescale_motion(run, paces)
            runs.append(Run(name, clock + run.time, run.voltage, run.position, run.velocity))
            clock = float(runs[-1].time[-1]) + 2.0
    problem = PredictionErrorProblem.from_records(
        make_run_records(Log(tuple(runs), units="meters", type="simple"))
    )
    nuisance = RunNuisance.at_first_samples(len(problem.records))
    return list(
        detect_slips(problem, problem.evaluate(BASE, gains(scale), nuisance, NOISE[1] ** 2))
    )


@pytest.mark.parametrize("scale", [LIGHT, HEAVY])
@pytest.mark.parametrize(
    ("test", "start", "end"),
    [
        ("quasistatic-forward", 3.0, 3.4),
        ("quasistatic-reverse", 0.8, 1.5),  # hardly seen as it begins: the speed is still low
        ("dynamic-forward", 0.28, 0.5),  # soon after a step
        ("dynamic-reverse", 0.6, 0.9),  # and over just before the end
    ],
)
@pytest.mark.parametrize("pace", [0.5, 1.6])
def test_a_slip_is_found(scale, test, start, end, pace):
    found = slips(scale, test=test, reads=[(start, end, pace)])

    assert [one.fault for _, one in found] == ["encoder-slip"]
    number, slip = found[0]
    run = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")
    assert run[number] == test
    assert slip.end - slip.start == pytest.approx(end - start, abs=2.0 * PERIOD)


@pytest.mark.parametrize("scale", [LIGHT, 0.1, HEAVY])
@pytest.mark.parametrize(("start", "end"), [(0.21, 0.33), (0.17, 0.31)])
@pytest.mark.parametrize("pace", [0.8, 1.3])
def test_a_slip_is_found_in_a_step_that_is_soon_over(scale, start, end, pace):
    found = slips(scale, test="dynamic-reverse", reads=[(start, end, pace)], lasts=0.48)

    assert [number for number, _ in found] == [3]
    assert found[0][1].end - found[0][1].start == pytest.approx(end - start, abs=2.0 * PERIOD)


@pytest.mark.parametrize("scale", [LIGHT, 0.1, HEAVY])
@pytest.mark.parametrize(("start", "end"), [(0.0, 0.1), (0.04, 0.19)])
def test_how_a_step_begins_is_no_slip(scale, start, end):
    lost = [(start, end, 0.6)]

    assert slips(scale, test="dynamic-reverse", lost=lost, lasts=0.48) == []


@pytest.mark.parametrize("scale", [LIGHT, 2.0 * LIGHT, HEAVY])
@pytest.mark.parametrize("lasts", [0.1, 0.3])
@pytest.mark.parametrize("times", [[4.0], [2.2, 3.5, 4.8, 6.1]])
def test_a_motor_without_its_voltage_is_no_slip(scale, lasts, times):
    lost = [(start, start + lasts, 0.5) for start in times]

    assert slips(scale, lost=lost) == []


def test_jumps_that_are_no_slip_make_what_looks_like_one_doubtful():
    real = (3.0, 3.4, 0.5)
    again = [(start, start + PERIOD, 0.5) for start in (3.99, 4.49, 4.99, 5.49)]  # one sample each

    assert slips(HEAVY, reads=[real])
    assert slips(HEAVY, reads=[real, *again]) == []


def test_so_light_a_mechanism_may_do_that():
    assert slips(0.5 * PERIOD, reads=[(3.0, 3.4, 0.5)]) == []
