"""Whether logs can be reconciled at all; if not, what to record instead."""

import numpy as np

from sim.errors import BadRequest, NotIdentifiable
from sim.fit.start import first_guess
from sim.log import Log
from sim.units import unit

FEWEST_RUNS, FEWEST_SAMPLES = 2, 60
BEYOND = 1.1  # [of the travel] that positions may span
OTHER = 4.0  # [factor] between two kV of one mechanism


def check_logs(
    log: Log, validation: Log | None, held_out: Log | None, *,
    type: str,  # noqa: A002 - the field's own word
    travel: float | None,
) -> None:  # fmt: skip
    """Refuse logs that cannot answer.

    Raises:
        BadRequest: units or gains that do not fit together, or positions beyond the travel.
        NotIdentifiable: too few runs, samples, or voltages.
    """
    long = [run for run in log.runs if len(run) > 3]  # noqa: PLR2004 - as ``see`` has it
    if len(long) < FEWEST_RUNS or sum(map(len, long)) < FEWEST_SAMPLES:
        raise NotIdentifiable(
            f"{len(long)} run{'s' * (len(long) != 1)} with {sum(map(len, long))} samples cannot "
            "show what a model lacks",
            where=log.source,
            advice="Record the four SysId tests, and repeat them with another step.",
        )
    if type == "arm" and not unit(log.units).angular:
        raise BadRequest(
            f"an arm's position must be an angle, and this log is in {log.units}",
            where=log.source,
            advice="Say --units radians, rotations or degrees, or --type elevator.",
        )
    own = first_guess(log, type=type)["kV"]
    for other in (validation, held_out):
        if other is not None:
            _check_other(log, other, own, type=type)
    if travel is not None:
        _check_travel(log, travel)


def _check_other(log: Log, other: Log, own: float, *, type: str) -> None:  # noqa: A002 - as above
    if unit(other.units).angular != unit(log.units).angular:
        raise BadRequest(
            f"positions in {other.units}, where {log.source} has {log.units}",
            where=other.source,
            advice="Give logs of one mechanism.",
        )
    try:
        found = first_guess(other, type=type)["kV"]
    except NotIdentifiable as problem:
        raise NotIdentifiable(
            problem.what, where=other.source, advice="Give a log with the four tests."
        ) from problem
    if not own / OTHER < found < own * OTHER:
        raise BadRequest(
            f"kV is about {found / own:.2g} times that of {log.source}",
            where=other.source,
            advice="Give logs of one mechanism, in the same units.",
        )


def _check_travel(log: Log, travel: float) -> None:
    spans = [run.position for run in log.runs if len(run)]
    way = float(max(map(np.max, spans)) - min(map(np.min, spans))) / unit(log.units).si
    if not travel > 0.0 or way > BEYOND * travel:
        raise BadRequest(
            f"positions span {way:.3g} {unit(log.units).symbol}, and the travel is {travel:g}",
            where=log.source,
            advice="Give the way from stop to stop, in the log's units, or leave it out.",
        )
