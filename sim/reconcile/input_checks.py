"""Check whether logs can be reconciled, and say what to record instead."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from sim.core.errors import BadRequest, NotIdentifiable
from sim.core.log import STANDSTILL, Log
from sim.core.units import Unit, find_unit
from sim.estimation.measurements import MIN_SAMPLES
from sim.estimation.model_structure import ModelStructure
from sim.fit.result import refuse_length_of_arm
from sim.physics.voltage_residual import VoltageResidual, compute_voltage_residual
from sim.reconcile.recordings import Recordings
from sim.reconcile.thresholds import FEWEST_SAMPLES, LOST, OTHER_UNITS

FEWEST_RUNS = 2


def check_logs(recordings: Recordings, *, travel: float | None) -> None:
    """Refuse logs that do not suffice to reconcile model and log.

    Args:
        recordings: the logs.
        travel: [log's unit] from stop to stop, if known.

    Raises:
        BadRequest: units or gains that do not fit together, or positions far beyond the travel.
        NotIdentifiable: too few runs, samples, or voltages.
    """
    log, base = recordings.log, recordings.type
    for one in recordings.logs_by_name.values():
        _check_samples(one)
    _check_size(log)
    refuse_length_of_arm(log, type=base)
    _check_voltage(log)
    guess = recordings.initial_gains
    _check_direction(log, guess, type=base)
    for name, other in recordings.logs_by_name.items():
        if name == "log":
            continue
        _check_units(log, other)
        _check_voltage(other)
        _check_moves(other, than=log.top_speed)
        if _follows_voltage(log, guess, type=base):
            _check_same(log, other, guess, type=base)
    if travel is not None:
        _check_travel(log, travel, recordings.unit)


def _check_samples(log: Log) -> None:
    empty = [number for number, run in enumerate(log.runs, 1) if not len(run)]
    if empty:
        raise NotIdentifiable(
            f"run {empty[0]} ({log.runs[empty[0] - 1].test}) has no samples",
            where=log.source,
            advice="Leave this run out.",
        )


def _check_size(log: Log) -> None:
    long = [run for run in log.runs if len(run) >= MIN_SAMPLES]
    count = sum(map(len, long))
    if len(long) >= FEWEST_RUNS and count >= FEWEST_RUNS * FEWEST_SAMPLES:
        return
    few = f"{len(long)} run{'s' * (len(long) != 1)} with {count} samples cannot show"
    raise NotIdentifiable(
        f"{few if long else 'runs of three samples or fewer do not show'} what a model lacks",
        where=log.source,
        advice="Record the four SysId tests, and repeat them with another step.",
    )


def _check_voltage(log: Log) -> None:
    if not any(run.voltage.any() for run in log.runs):
        raise NotIdentifiable(
            "the voltage is 0 V from beginning to end",
            where=log.source,
            advice="Log the voltage that is applied to the motor.",
        )


def _check_direction(log: Log, guess: Mapping[str, float], *, type: str) -> None:  # noqa: A002 - field's word
    """Refuse a log whose motion follows the voltage only with the opposite sign."""
    backward = {name: -value for name, value in guess.items()}
    runs = tuple(replace(run, voltage=-run.voltage) for run in log.runs)
    if _follows_voltage(replace(log, runs=runs), backward, type=type):
        raise BadRequest(
            "a positive voltage drives it backward",
            where=log.source,
            advice=(
                "Invert the encoder or the motor, so that a positive voltage gives a positive "
                "velocity, and record again."
            ),
        )


def _check_units(log: Log, other: Log) -> None:
    if find_unit(other.units).angular != find_unit(log.units).angular:
        raise BadRequest(
            f"positions in {other.units}, where {log.source or 'the first log'} has {log.units}",
            where=other.source,
            advice="Give logs of one mechanism.",
        )


def _check_moves(log: Log, *, than: float) -> None:
    if not log.top_speed > STANDSTILL * than:
        raise NotIdentifiable(
            "the mechanism hardly moves in this log",
            where=log.source,
            advice="Use a log with the four tests, recorded with another step.",
        )


def _check_same(log: Log, other: Log, guess: Mapping[str, float], *, type: str) -> None:  # noqa: A002 - field's word
    residual = _compute_base_residual(other, guess, type=type)
    square = float(residual.velocity @ residual.velocity)
    if square == 0.0:
        raise NotIdentifiable(
            "no run is long enough to be compared",
            where=other.source,
            advice="Use a log with the four tests, recorded with another step.",
        )
    kv = guess["kV"] + float(residual.missing @ residual.velocity) / square
    factor = kv / guess["kV"]
    if not 1.0 / OTHER_UNITS < factor < OTHER_UNITS:
        raise BadRequest(
            _describe_difference(factor, log.source or "the first log"),
            where=other.source,
            advice="Give logs of one mechanism, in the same units.",
        )


def _describe_difference(factor: float, first: str) -> str:
    """How the voltages of a log differ from those of the first one at the same speed."""
    if factor < -1.0 / OTHER_UNITS:
        return f"it goes the other way than {first} at the same voltage"
    times = f"{factor:.2g} times" if factor > 0.0 else "none of"
    return f"a speed takes {times} the voltage that it takes in {first}"


def _follows_voltage(log: Log, guess: Mapping[str, float], *, type: str) -> bool:  # noqa: A002 - field's word
    """Whether physical gains explain most of the voltage of a log."""
    residual = _compute_base_residual(log, guess, type=type)
    if guess["kV"] <= 0.0 or guess["kA"] <= 0.0 or guess["kS"] < 0.0:
        return False
    missing, voltage = residual.missing, residual.voltage
    return float(missing @ missing) < LOST**2 * float(voltage @ voltage)


def _compute_base_residual(log: Log, guess: Mapping[str, float], *, type: str) -> VoltageResidual:  # noqa: A002 - field's word
    return compute_voltage_residual(log, dict(ModelStructure(type).model(guess).gains), type=type)


def _check_travel(log: Log, travel: float, unit: Unit) -> None:
    spans = [run.position for run in log.runs if len(run)]
    span = float(max(map(np.max, spans)) - min(map(np.min, spans))) / unit.si
    if not travel > 0.0 or span > OTHER_UNITS * travel:
        raise BadRequest(
            f"positions span {span:.3g} {unit.symbol}, and the travel is {travel:g}",
            where=log.source,
            advice="Give the distance from stop to stop, in the log's units, or leave it out.",
        )
