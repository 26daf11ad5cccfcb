"""Acceleration against velocity of the rows that SysId uses."""

from dataclasses import replace

import numpy as np
import pytest
from handmade import FOUR, log_of

import sim
from sim.core.errors import NotIdentifiable
from sim.core.log import FOUR_TESTS, Log
from sim.plot import plot_acceleration_velocity

PERIOD, STEP = 0.02, 0.0005  # [s] between samples, and between two steps of the motion
KS, KV, KA = 0.2, 2.0, 0.3


def _swing():
    """Four tests of a mechanism with these gains, in small steps."""
    runs = []
    for number, test in enumerate(FOUR_TESTS):
        sign = 1.0 if test.endswith("forward") else -1.0
        x = v = 0.0
        rows = []
        for sample in range(150):
            volts = sign * (1.2 * PERIOD * (sample + 1) if test.startswith("quasi") else 3.0)
            rows.append((4.0 * number + PERIOD * sample, volts, x, v))
            for _ in range(round(PERIOD / STEP)):
                if v == 0.0 and abs(volts) <= KS:
                    continue
                v += STEP * (volts - sign * KS - KV * v) / KA
                x += STEP * v
        runs.append(sim.Run(test, *np.array(rows).T))
    return Log(tuple(runs))


def test_a_step_falls_on_the_line_of_its_gains():
    picture = plot_acceleration_velocity(_swing())
    step = next(row for row in picture.table.rows if row[0] == "dynamic-forward")
    # under 3 V: (3.0 - 0.2)/0.3 at standstill, falling by kV/kA per second
    assert step[4] == pytest.approx(2.8 / 0.3, rel=0.05)
    assert step[5] == pytest.approx(-2.0 / 0.3, rel=0.05)
    assert len(picture.figure.axes[0].lines) == 4


@pytest.mark.parametrize(
    "log",
    [Log(()), replace(FOUR, runs=FOUR.runs[:3]), log_of(*FOUR_TESTS, seconds=0.02)],
    ids=["empty", "a test is missing", "one sample each"],
)
def test_what_sysid_cannot_use_is_refused(log):
    with pytest.raises(NotIdentifiable):
        plot_acceleration_velocity(log)
