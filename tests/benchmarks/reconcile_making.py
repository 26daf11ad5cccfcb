"""Make one case of the benchmark of reconcile: three logs, what a team knows, and the answer."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from reconcile_plan import FAULTS, Case
from reconcile_recording import (
    SESSIONS,
    Day,
    Levels,
    Moves,
    exchanged,
    happened,
    heated,
    on_the_bench,
    permuted,
    recorded,
)
from reconcile_sizes import hide

from sim.core.log import Log
from sim.core.units import find_unit
from sim.inspect.contaminate import contaminate
from sim.io import write

QUICK = 0.25  # [share] of mechanisms with stops that are logged every 5 ms


@dataclass(frozen=True, eq=False)
class Made:
    """A case as it is written.

    Args:
        logs: name of a file -> its log.
        known: what a team knows.
        answer: what a solver has to find.
    """

    logs: Mapping[str, Log]
    known: Mapping[str, object]
    answer: Mapping[str, object]


def make(case: Case, *, seed: int, moved: Moves = on_the_bench) -> Made:
    """One case, the same for the same seed.

    Args:
        case: what it is.
        seed: of the whole benchmark.
        moved: the physics.
    """
    rng = np.random.default_rng([seed, case.number])
    hidden = hide(case, rng=rng)
    quick = hidden.mechanism.stops is not None and rng.random() < QUICK
    period = 0.005 if quick else 0.02
    levels = Levels.draw(hidden.mechanism, rng)
    hidden = heated(hidden, levels, period=period, rng=rng, moved=moved)
    hidden = happened(hidden, levels, period=period, rng=rng, moved=moved)
    day = Day.draw(hidden, rng, dirty=case.dirty)
    logs = {
        name: recorded(hidden, levels, day, session=name, period=period, rng=rng, moved=moved)
        for name in SESSIONS
    }
    for name in (one for one in case.hidden if one in FAULTS):
        damaged = contaminate(logs["train"], name, severity=hidden.sizes[name], rng=rng)
        logs["train"] = damaged.log
    if case.shuffled:
        spoil = permuted if case.shuffled == "permuted" else exchanged
        logs = {name: spoil(log, rng=rng) for name, log in logs.items()}
    known = {
        "type": case.type,
        "mechanism": case.mechanism,
        "travel": hidden.mechanism.travel,
        "period_s": period,
    }
    answer = {
        "effects": list(case.effects),
        "detail": list(case.hidden),
        "severity": case.severity,
        "dirty": case.dirty,
        "shuffled": case.shuffled,
        "made": hidden.told,
    }
    return Made(logs, known, answer)


def store(
    case: Case, *, seed: int, out: Path, moved: Moves = on_the_bench
) -> tuple[str, Mapping[str, object]]:
    """Write a case into its folder.

    Returns:
        The folder's name under ``out`` and the answer, which is not in it.
    """
    made = make(case, seed=seed, moved=moved)
    name = f"{case.number:03d}"
    folder = out / ("shuffled" if case.shuffled else "") / name
    folder.mkdir(parents=True)
    for file, log in made.logs.items():
        si = replace(log, units="radians" if find_unit(log.units).angular else "meters")
        write(si, folder / f"{file}.csv")
    (folder / "case.json").write_text(json.dumps(made.known), encoding="utf-8")
    return folder.relative_to(out).as_posix(), made.answer
