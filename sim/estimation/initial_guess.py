"""A first estimate of the gains from integrals, without differentiation.

Over a short while in which a mechanism moves one way,

    ∫V dt = kS·∫sgn(v) dt + kV·Δx + kA·Δv + ∫gravity dt

so nothing has to be differentiated: noise enters once at each end, not divided by the time between.
Good enough to begin a search from, whatever the tests were.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from sim.core.errors import NotIdentifiable
from sim.core.log import Array, Log, Run

SHORTEST = 0.2  # [s] of a while; at least four samples
SAME = 0.03  # [share of the voltage] a smaller change of it tells nothing
STANDING = 0.02  # [share of the top speed] below which nothing is said about a gain
LEAST_PERIODS = 0.05  # [sample periods] a shorter timescale leaves hardly a trace
LEAST_TIMESCALE, MOST_TIMESCALE = 1e-3, 10.0  # [s] of anything on a robot


def guess_gains(log: Log, *, type: str) -> dict[str, float]:  # noqa: A002 - the field's own word
    """First estimates of kS, kV, kA, and of ``kG`` (elevator) or ``level`` and ``upright`` (arm).

    Args:
        log: any runs.
        type: ``simple``, ``elevator`` or ``arm``.

    Raises:
        NotIdentifiable: nothing moves for long enough.

    Returns:
        Raw: a log whose signs are opposed has a negative kV.
    """
    top = log.top_speed
    parts = [
        _integral_rows(run, standing=STANDING * top, type=type) for run in log.runs if len(run) > 1
    ]
    table = np.concatenate(parts) if parts else np.empty((0, 4))
    names = ("kS", "kV", "kA", *{"elevator": ("kG",), "arm": ("level", "upright")}.get(type, ()))
    if top == 0.0 or table.shape[0] < 2 * len(names):
        raise NotIdentifiable(
            "the mechanism hardly moves in this log",
            where=log.source,
            advice="Run the tests with a higher voltage, or hold the button longer.",
        )
    paid, columns = table[:, 0], table[:, 1:]
    _refuse_constant_voltage(paid, columns[:, 0], where=log.source)
    size = np.linalg.norm(columns, axis=0)
    size[size == 0.0] = 1.0
    found = np.linalg.lstsq(columns / size, paid, rcond=1e-8)[0] / size
    return dict(zip(names, found.tolist(), strict=True))


def orient_forward(log: Log, *, type: str) -> tuple[Log, dict[str, float], float]:  # noqa: A002 - as above
    """The log with signs such that positive voltage drives forward, and its first guess.

    Args:
        log: any runs.
        type: ``simple``, ``elevator`` or ``arm``.

    Raises:
        NotIdentifiable: as ``guess_gains``.

    Returns:
        The log, voltages turned round where plus drives it backward; the guess; 1 or, if so, -1.
    """
    guess = guess_gains(log, type=type)
    if not guess["kV"] < 0.0:
        return log, guess, 1.0
    runs = tuple(replace(run, voltage=-run.voltage) for run in log.runs)
    log = replace(log, runs=runs)
    return log, guess_gains(log, type=type), -1.0


def _refuse_constant_voltage(paid: Array, ways: Array, *, where: str) -> None:
    """Refuse a voltage that is always the same: friction might be all there is."""
    share = float(paid @ ways) / max(float(ways @ ways), 1e-300)
    if np.linalg.norm(paid - share * ways) < SAME * np.linalg.norm(paid):
        raise NotIdentifiable(
            f"the voltage is {abs(share):.3g} V whenever it moves, so friction, speed and inertia "
            "cannot be told apart",
            where=where,
            advice="Add a quasistatic test, or a step of another size.",
        )


def clamp_to_physical(gains: Mapping[str, float], *, period: float = 0.0) -> dict[str, float]:
    """The gains, clamped to values from which a simulation can start.

    Args:
        gains: a raw guess.
        period: [s] between samples.
    """
    kv = abs(gains["kV"])
    low, high = max(LEAST_TIMESCALE, LEAST_PERIODS * period) * kv, MOST_TIMESCALE * kv
    return {
        **gains,
        "kS": max(gains["kS"], 0.0),
        "kV": kv,
        "kA": min(max(gains["kA"], low), high) if kv > 0.0 else abs(gains["kA"]),
    }


def _integral_rows(run: Run, *, standing: float, type: str) -> Array:  # noqa: A002 - as above
    """(rows, 1 + gains): what was paid, and for what, over whiles that do not overlap by much."""
    dt = np.diff(run.time)
    reach = max(4, round(SHORTEST / float(np.median(dt))))
    if len(run) <= reach:
        return np.empty((0, 4 + {"elevator": 1, "arm": 2}.get(type, 0)))
    way = np.sign(run.velocity)
    moving = np.abs(run.velocity) > standing
    begin = np.arange(0, len(run) - reach, max(1, reach // 4))
    end = begin + reach
    still = np.concatenate(([0], np.cumsum(~moving)))
    turned = np.concatenate(([0], np.cumsum(np.concatenate(([False], way[1:] != way[:-1])))))
    whole = (still[end + 1] == still[begin]) & (turned[end + 1] == turned[begin + 1])
    begin, end = begin[whole], end[whole]

    def total(values: Array) -> Array:
        sums = np.concatenate(([0.0], np.cumsum(values[:-1] * dt)))
        return np.asarray(sums[end] - sums[begin])

    columns = [
        total(run.voltage + 0.5 * run.voltage_slide),
        total(way),
        run.position[end] - run.position[begin],
        run.velocity[end] - run.velocity[begin],
    ]
    if type == "elevator":
        columns.append(run.time[end] - run.time[begin])
    elif type == "arm":
        columns += [total(np.cos(run.position)), total(np.sin(run.position))]
    return np.column_stack(columns)
