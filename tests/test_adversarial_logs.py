"""What real runs vary and no simulation of one session does: gains hold within their errors."""

from dataclasses import replace

import numpy as np
import pytest

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import Log
from sim.fit import fit
from sim.physics.battery import Battery

ROUTINE = Routine(ramp=0.5, step=3.5)


def record_each(mechanism, vary, *, seed):
    """Four tests, each of a mechanism that is changed a little."""
    rng = np.random.default_rng(seed)
    logs = [simulate(vary(mechanism, rng), ROUTINE, rng=rng) for _ in ROUTINE.tests]
    runs = tuple(log.runs[place] for place, log in enumerate(logs))
    return replace(logs[0], runs=runs)


def drift_clocks(log, rng):
    """The log by a clock that is up to a ten-thousandth too fast or slow in each run."""
    return Log(
        tuple(
            replace(run, time=run.time[0] + (run.time - run.time[0]) * (1.0 + rng.normal(0, 1e-4)))
            for run in log.runs
        ),
        units=log.units, type=log.type,
    )  # fmt: skip


VARIED = {
    "friction": lambda one, rng: replace(one, friction=one.friction * rng.normal(1.0, 0.04)),
    "battery": lambda one, rng: replace(one, battery=Battery(rng.uniform(11.8, 12.8), 0.015)),
}


@pytest.mark.parametrize("name", ["drivetrain", "elevator", "arm"])
@pytest.mark.parametrize("what", [*VARIED, "clock"])
def test_gains_are_right_when_friction_differs_between_runs(name, what):
    mechanism, off = MECHANISMS[name], []
    for seed in range(4):
        log = record_each(mechanism, VARIED.get(what, lambda one, _: one), seed=seed)
        if what == "clock":
            log = drift_clocks(log, np.random.default_rng(seed))
        found = fit(log, type=mechanism.type)
        off += [
            abs(found.gains[gain] - true) / max(found.errors[gain], 1e-3 * true)
            for gain, true in mechanism.gains.items()
        ]

    assert np.mean(np.array(off) < 3.0) > 0.9, np.round(off, 1)
