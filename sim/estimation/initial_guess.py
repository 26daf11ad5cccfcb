"""A first estimate of the gains by integral regression, without differentiation.

Over a short interval in which a mechanism moves in one direction,

    ∫V dt = kS·∫sgn(v) dt + kV·Δx + kA·Δv + ∫gravity dt

so nothing has to be differentiated: noise enters only at the two ends of an interval, and is not
divided by a sample period. The result is good enough to start a search from, for any tests.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from sim.core.errors import NotIdentifiable
from sim.core.log import STANDSTILL, Array, Log, Run
from sim.estimation.model_structure import BASE

INTERVAL = 0.2  # [s] length of an integration interval; at least four samples
LEAST_VARIATION = 0.03  # [share of the voltage] a voltage that varies less is constant
LEAST_PERIODS = 0.05  # [sample periods] a shorter kA/kV cannot be seen in the samples
LEAST_TIMESCALE, MOST_TIMESCALE = 1e-3, 10.0  # [s] limits of kA/kV on a robot


def guess_gains(log: Log, *, type: str) -> dict[str, float]:  # noqa: A002 - the field's own word
    """First estimates of kS, kV, kA, and of ``kG`` (elevator) or ``level`` and ``upright`` (arm).

    Args:
        log: any runs.
        type: ``simple``, ``elevator`` or ``arm``.

    Returns:
        Gain -> estimate, not clamped: kV is negative if voltage and velocity have opposite signs.

    Raises:
        NotIdentifiable: nothing moves for long enough, or the voltage is always the same.
    """
    top = log.top_speed
    parts = [
        _integrate_rows(run, standing=STANDSTILL * top, type=type)
        for run in log.runs
        if len(run) > 1
    ]
    names = BASE[type]
    table = np.concatenate([np.empty((0, 1 + len(names))), *parts])
    if top == 0.0 or table.shape[0] < 2 * len(names):
        raise NotIdentifiable(
            "the mechanism hardly moves in this log",
            where=log.source,
            advice="Run the tests with a higher voltage, or hold the button longer.",
        )
    integrals, columns = table[:, 0], table[:, 1:]
    _refuse_constant_voltage(integrals, columns[:, 0], where=log.source)
    size = np.linalg.norm(columns, axis=0)
    size[size == 0.0] = 1.0
    found = np.linalg.lstsq(columns / size, integrals, rcond=1e-8)[0] / size
    return dict(zip(names, found.tolist(), strict=True))


def orient_forward(log: Log, *, type: str) -> tuple[Log, dict[str, float], float]:  # noqa: A002 - as above
    """The log with signs such that positive voltage drives forward, and its first guess.

    Args:
        log: any runs.
        type: ``simple``, ``elevator`` or ``arm``.

    Returns:
        The log, its voltages negated if positive voltage drives backward; the guess for it; and the
        sign by which the voltages were multiplied, 1 or -1.

    Raises:
        NotIdentifiable: as ``guess_gains``.
    """
    guess = guess_gains(log, type=type)
    if not guess["kV"] < 0.0:
        return log, guess, 1.0
    runs = tuple(replace(run, voltage=-run.voltage) for run in log.runs)
    log = replace(log, runs=runs)
    return log, guess_gains(log, type=type), -1.0


def _refuse_constant_voltage(integrals: Array, directions: Array, *, where: str) -> None:
    """Raise NotIdentifiable if the voltage is always ± the same: it could all be kS.

    Args:
        integrals: (rows,) [V·s] ∫V dt of each interval.
        directions: (rows,) [s] ∫sgn(v) dt of each interval.
        where: source of the log.
    """
    volts = float(integrals @ directions) / max(float(directions @ directions), 1e-300)
    left = np.linalg.norm(integrals - volts * directions)
    if left < LEAST_VARIATION * np.linalg.norm(integrals):
        raise NotIdentifiable(
            f"the voltage is {abs(volts):.3g} V whenever the mechanism moves, so friction, speed "
            "and inertia cannot be separated",
            where=where,
            advice="Add a quasistatic test, or a step of another size.",
        )


def clamp_to_physical(gains: Mapping[str, float], *, period: float = 0.0) -> dict[str, float]:
    """The gains, clamped to values from which a simulation can start.

    Args:
        gains: a raw guess, in SI.
        period: [s] time between samples.
    """
    kv = abs(gains["kV"])
    low, high = max(LEAST_TIMESCALE, LEAST_PERIODS * period) * kv, MOST_TIMESCALE * kv
    return {
        **gains,
        "kS": max(gains["kS"], 0.0),
        "kV": kv,
        "kA": min(max(gains["kA"], low), high) if kv > 0.0 else abs(gains["kA"]),
    }


def _integrate_rows(run: Run, *, standing: float, type: str) -> Array:  # noqa: A002 - as above
    """(rows, 1 + gains): ∫V dt and the regressors, over intervals without a change of direction."""
    dt = np.diff(run.time)
    reach = max(4, round(INTERVAL / float(np.median(dt))))
    direction = np.sign(run.velocity)
    moving = np.abs(run.velocity) > standing
    begin = np.arange(0, len(run) - reach, max(1, reach // 4))
    end = begin + reach
    standing_count = np.concatenate(([0], np.cumsum(~moving)))
    turns = np.concatenate(([False], direction[1:] != direction[:-1]))
    turn_count = np.concatenate(([0], np.cumsum(turns)))
    moves = standing_count[end + 1] == standing_count[begin]
    one_way = moves & (turn_count[end + 1] == turn_count[begin + 1])
    begin, end = begin[one_way], end[one_way]

    def sum_columns(values: Array) -> Array:
        sums = np.concatenate(([0.0], np.cumsum(values[:-1] * dt)))
        return np.asarray(sums[end] - sums[begin])

    columns = [
        sum_columns(run.voltage + 0.5 * run.voltage_slide),
        sum_columns(direction),
        run.position[end] - run.position[begin],
        run.velocity[end] - run.velocity[begin],
    ]
    if type == "elevator":
        columns.append(run.time[end] - run.time[begin])
    elif type == "arm":
        columns += [sum_columns(np.cos(run.position)), sum_columns(np.sin(run.position))]
    return np.column_stack(columns)
