"""Logs and figures made by WPILib SysId's own analysis core, read for the tests that compare."""

import csv
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sim.core.log import Log, Run
from sim.core.units import find_unit

ANSWERS = Path(__file__).parent / "sysid_answers"
NAMES = (
    "simple-clean-20ms",
    "simple-noisy-20ms",
    "simple-noisy-20ms.median5",
    "simple-light-5ms",
    "elevator-noisy-20ms",
    "arm-rad-20ms",
    "arm-rot-20ms",
)


@dataclass(frozen=True)
class KnownAnswer:
    """A log and what SysId made of it."""

    log: Log
    type: str
    median: int
    answer: dict[str, object]


def known_answer(name: str) -> KnownAnswer:
    """Load one of ``NAMES``, parsed by hand so that no reader of ours can spoil it."""
    answer = json.loads((ANSWERS / f"{name}.json").read_text(encoding="utf-8"))
    units = answer["units"].lower()
    table = ANSWERS / f"{name.partition('.')[0]}.csv"
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    runs = []
    for test in dict.fromkeys(row["test"] for row in rows):
        part = [row for row in rows if row["test"] == test]
        time, voltage, position, velocity = (
            np.array([float(row[column]) for row in part])
            for column in ("time_s", "voltage", "position", "velocity")
        )
        si = find_unit(units).si
        runs.append(Run(test, time, voltage, position * si, velocity * si))
    return KnownAnswer(
        Log(tuple(runs), units=units), answer["type"].lower(), answer["median_window"], answer
    )
