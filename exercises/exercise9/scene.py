"""What wrong numbers are recognized by: the mechanism, its tests, and what wrong recipes give."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from grader.answers.asked_number import AskedNumber
from grader.answers.wrong_number import Scene, Slips
from sim.bench.mechanism import Mechanism
from sim.core.log import Array, Log
from sim.core.units import find_unit

STANDSTILL = 0.02  # [share of the top speed] slower rows say nothing about a gain
USUAL = 0.02  # [s] between two samples of a robot program, and of the learner's own log

SLIPS = Slips(Path(__file__).with_name("slips.toml"))
ASSUMED = SLIPS.name("period-assumed")


def make_columns(log: Log, *, si: float) -> tuple[Array, Array]:
    """Columns (n, 3) for kS, kV and kA, and the voltage (n,), of every row that moves.

    Args:
        log: the tests.
        si: [m or rad] of the unit that gains are asked in.
    """
    rows, voltage = [], []
    for run in log.runs:
        v = run.velocity / si
        moving = np.abs(v) > STANDSTILL * np.abs(v).max()
        a = np.gradient(v, run.time)
        rows.append(np.column_stack((np.sign(v), v, a))[moving])
        voltage.append(run.voltage[moving])
    return np.vstack(rows), np.concatenate(voltage)


def make_scene(
    mechanism: Mechanism,
    log: Log,
    asked: Mapping[str, AskedNumber],
    *,
    ramp: float,
    period: float,
) -> Scene:
    """The scene of one log.

    Args:
        mechanism: what was tested.
        log: its tests.
        asked: the gains, in the order of the columns.
        ramp: [V/s] of the quasistatic tests.
        period: [s] between two samples.
    """
    explained, *_ = np.linalg.lstsq(
        *make_columns(log, si=find_unit(mechanism.units).si), rcond=None
    )
    looks = {
        name: SLIPS.list_lookalikes([("voltage-explained", float(value))])
        for name, value in zip(asked, explained, strict=True)
    }
    return Scene(
        angular=mechanism.units != "meters",
        ratio=mechanism.ratio,
        motors=mechanism.motor_count,
        ramp=ramp,
        period=period,
        lookalikes=looks,
    )
