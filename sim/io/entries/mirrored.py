"""Motors of one mechanism that are mounted the other way round."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from sim.core.doubt import Doubt
from sim.core.log import Log, Run
from sim.core.vocabulary import find_test_sign


def turn_mirrored_motors(logs: Mapping[str, Log]) -> dict[str, Log]:
    """The logs, with reversed signals for motors that run against their tests and other motors.

    Args:
        logs: the name of each motor -> its log.
    """
    ways = {name: _sum_voltage(log) for name, log in logs.items()}
    if not any(way > 0.0 for way in ways.values()):
        return dict(logs)
    return {
        name: _reverse_log(log, name) if ways[name] < 0.0 else log for name, log in logs.items()
    }


def _sum_voltage(log: Log) -> float:
    """Sum of voltages, negated in reverse tests [V]; negative for a mirrored motor."""
    return sum(find_test_sign(run.test) * float(np.sum(run.voltage)) for run in log.runs)


def _reverse_log(log: Log, name: str) -> Log:
    doubt = Doubt(
        "mirrored-motor",
        f"{log.source}: motor {name!r} has a negative voltage in forward tests, and others a "
        "positive one; its signals were reversed. If it is not mounted the other way round, look "
        "at which motors are inverted.",
    )
    return replace(log, runs=tuple(map(_reverse_run, log.runs))).add_doubts(doubt)


def _reverse_run(run: Run) -> Run:
    current = None if run.current is None else -run.current
    return replace(
        run,
        voltage=-run.voltage,
        position=-run.position,
        velocity=-run.velocity,
        current=current,
    )
