"""Cut the signals of a mechanism's motors into runs, by the intervals of its tests."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import TypeAlias

import numpy as np

from sim.core.advice import Action
from sim.core.doubt import Doubt
from sim.core.errors import BadRequest
from sim.core.log import Array, Run
from sim.core.units import UNITS
from sim.io.entries.clock import (
    Series,
    find_loop_times,
    find_sparse_signals,
    hold_last_value,
    interpolate_linear,
    logs_only_changes,
    select_covered_times,
)
from sim.io.entries.entry import NEEDED, OPTIONAL, SECOND, MotorEntries, Numbers
from sim.io.entries.state import RunInterval
from sim.io.entries.units import EntryScale, choose_scale, is_from_network_tables
from sim.io.format import ReadOptions, make_run

MIN_SAMPLES = 2  # samples of a run at least
ENDS = 2  # samples that a run may lose without a doubt, one at each end
OPPOSED = -0.5  # [1] cosine similarity; motors that work against each other are near -1

Signals: TypeAlias = Mapping[str, Sequence[Series]]  # signal -> its series for each motor


@dataclass(frozen=True, eq=False)
class _Sampled:
    """One run on a common time base.

    Args:
        test: the test.
        time: (n,) [µs].
        signals: signal -> (motors, n).
        lost: number of voltage samples left out because another signal is missing there.
    """

    test: str
    time: Numbers
    signals: Mapping[str, Array]
    lost: int = 0


def cut_runs(
    motors: Sequence[MotorEntries],
    intervals: Sequence[RunInterval],
    *,
    options: ReadOptions,
    where: str,
) -> tuple[list[Run], str, list[Doubt]]:
    """Cut the signals of a mechanism's motors into its runs; several motors count as their mean.

    Returns:
        The runs in the order they were recorded, their unit of position, and doubts about them.

    Raises:
        BadRequest: motors logged in an angle and in a length, or that work against each other.
        BadSample: a value that cannot be a measurement.
    """
    scales = _choose_scales(motors, options=options, where=where)
    signals = _scale_signals(motors, scales)
    needed = [series for name in _list_needed(signals) for series in signals[name]]
    spans = [(interval.begin, interval.end) for interval in intervals]
    entries = [motor.signals[name] for motor in motors for name in _list_needed(signals)]
    held = logs_only_changes(needed, spans, suspected=all(map(is_from_network_tables, entries)))
    doubts = [doubt for scale in scales for doubt in scale.doubts]
    doubts += _doubt_sparse_signals(signals, spans, held=held, where=where)
    sampled = [
        (_sample_held if held else _sample_interpolated)(signals, interval)
        for interval in intervals
    ]
    whole = [run for run in sampled if run.time.size >= MIN_SAMPLES]
    doubts += _doubt_short_runs(sampled, where)
    doubts += _doubt_combined_motors(motors, whole, where)
    units, runs = scales[0].units, []
    for run in whole:
        found, warnings = make_run(run.test, _average_motors(run), si=UNITS[units].si, where=where)
        runs.append(found)
        doubts += warnings
    return runs, units, doubts


def _choose_scales(
    motors: Sequence[MotorEntries], *, options: ReadOptions, where: str
) -> list[EntryScale]:
    """The scale of each motor, to the unit of the first.

    Raises:
        BadRequest: one motor is logged in an angle and another in a length.
    """
    first = choose_scale(motors[0].signals, options=options, where=where)
    scales = [first]
    for motor in motors[1:]:
        scale = choose_scale(motor.signals, options=options, where=where)
        if UNITS[scale.units].angular != UNITS[first.units].angular:
            raise BadRequest(
                f"motor {motors[0].name!r} is logged in {first.units}, {motor.name!r} in "
                f"{scale.units}: an angle and a length",
                where=where,
                advice=Action("option", f"with --motor {motors[0].name}"),
            )
        ratio = UNITS[scale.units].si / UNITS[first.units].si
        factors = {
            signal: factor if signal == "voltage" else factor * ratio
            for signal, factor in scale.factors.items()
        }
        scales.append(replace(scale, units=first.units, factors=factors))
    return scales


def _scale_signals(
    motors: Sequence[MotorEntries], scales: Sequence[EntryScale]
) -> dict[str, list[Series]]:
    """The series of each signal that all motors have, in the unit of the log, for each motor."""
    shared = [name for name in NEEDED + OPTIONAL if all(name in motor.signals for motor in motors)]
    signals: dict[str, list[Series]] = {name: [] for name in shared}
    for motor, scale in zip(motors, scales, strict=True):
        for name in shared:
            entry = motor.signals[name]
            values, factor = entry.numbers(), scale.factors.get(name, 1.0)
            signals[name].append(Series(entry.time, values if factor == 1.0 else values * factor))
    return signals


def _list_needed(signals: Iterable[str]) -> list[str]:
    """The required signals: a sample that lacks one is left out."""
    return [name for name in NEEDED if name in signals]


def _sample_held(signals: Signals, interval: RunInterval) -> _Sampled:
    """One run of a log in which only changes were logged: each value holds until the next."""
    needed = [series for name in _list_needed(signals) for series in signals[name]]
    time = find_loop_times(needed, interval.begin, interval.end)
    known = {
        name: np.array([hold_last_value(one, time) for one in several])
        for name, several in signals.items()
        if time.size and all(one.time[0] <= time[0] for one in several)
    }
    return _Sampled(interval.test, time, known)


def _sample_interpolated(signals: Signals, interval: RunInterval) -> _Sampled:
    """One run at the times of the first motor's voltage, with the other signals interpolated."""
    parts = {
        name: [one.between(interval.begin, interval.end) for one in several]
        for name, several in signals.items()
    }
    usable = {
        name: several
        for name, several in parts.items()
        if all(part.time_count >= MIN_SAMPLES for part in several)
    }
    every = parts["voltage"][0].time
    if not usable.keys() >= set(_list_needed(signals)):
        return _Sampled(interval.test, every[:0], {})
    needed = [part for name in _list_needed(signals) for part in usable[name]]
    time = select_covered_times(needed, every)
    columns = {
        name: np.array([interpolate_linear(part, time) for part in several])
        for name, several in usable.items()
    }
    return _Sampled(interval.test, time, columns, every.size - time.size)


def _average_motors(run: _Sampled) -> dict[str, Array]:
    """The columns of a run for ``make_run``: time in seconds, and the mean of the motors."""
    columns = {"time": run.time / SECOND}
    for name, rows in run.signals.items():
        columns[name] = rows[0] if len(rows) == 1 else rows.mean(axis=0)
    return columns


def _doubt_short_runs(runs: Sequence[_Sampled], where: str) -> Iterator[Doubt]:
    for run in runs:
        if run.time.size < MIN_SAMPLES:
            yield Doubt(
                "short-run",
                f"{where}: a run of {run.test} holds fewer than {MIN_SAMPLES} samples of voltage, "
                "position and velocity and was left out. Run that test again.",
            )
        elif run.lost > ENDS:
            yield Doubt(
                "short-signal",
                f"{where}, {run.test}: {run.lost} of {run.lost + run.time.size} samples were left "
                "out, as position or velocity was not logged then. Look at how they are logged.",
            )


def _doubt_sparse_signals(
    signals: Signals, spans: Sequence[tuple[int, int]], *, held: bool, where: str
) -> Iterator[Doubt]:
    """Doubts about signals that were not logged in every loop."""
    needed = [(name, series) for name in _list_needed(signals) for series in signals[name]]
    parts = [[series.between(*span) for span in spans] for _, series in needed]
    counts = {name: sum(map(len, row)) for (name, _), row in zip(needed, parts, strict=True)}
    many = ", ".join(f"{count} samples of {name}" for name, count in counts.items())
    if held:
        yield Doubt(
            "change-only",
            f"{where}: only changes were logged ({many}). So each value was repeated until its "
            "next change. SysId itself uses only the times at which the voltage changed. It fails "
            "on such a log, because the voltage of a step does not change. Log every value in "
            "every loop.",
        )
    elif any(find_sparse_signals(parts)):
        yield Doubt(
            "uneven-rates",
            f"{where}: the signals were logged at different rates ({many}). As in "
            "SysId, the other signals were interpolated to the times of the voltage. Log "
            "every signal in every loop.",
        )


def _doubt_combined_motors(
    motors: Sequence[MotorEntries], runs: Sequence[_Sampled], where: str
) -> Iterator[Doubt]:
    """A doubt that says that the signals are the mean of several motors.

    Raises:
        BadRequest: two of them have voltages or velocities of opposite sign.
    """
    if len(motors) == 1:
        return
    names = [motor.name for motor in motors]
    directed = [name for name in ("voltage", "velocity") if runs and name in runs[0].signals]
    for signal in directed:
        rows = np.concatenate([run.signals[signal] for run in runs], axis=1)
        length = np.linalg.norm(rows, axis=1)
        for i, j in combinations(range(len(names)), 2):
            if rows[i] @ rows[j] < OPPOSED * length[i] * length[j]:
                raise BadRequest(
                    f"the {signal} has opposite signs for the motors {names[i]!r} and "
                    f"{names[j]!r}, so their mean says nothing",
                    where=where,
                    advice=Action(
                        "option",
                        f"with --motor {names[i]}",
                        before="If one is inverted, say so in the robot code.",
                    ),
                )
    yield Doubt(
        "several-motors",
        f"{where}: the signals are the mean of motors {', '.join(map(repr, names))}.",
        action=Action("option", f"with --motor NAME, for instance --motor {names[0]}"),
    )
