"""Files as the tools of 2019 to 2023 wrote them, made up for the tests that read them."""

import json
from pathlib import Path
from typing import Any

import numpy as np

import sim
from sim.core.doubt import Doubt
from sim.core.log import Array, Log

RUNS = {
    "slow-forward": "quasistatic-forward",
    "slow-backward": "quasistatic-reverse",
    "fast-forward": "dynamic-forward",
    "fast-backward": "dynamic-reverse",
}
COUNT = 40
PERIOD = 0.02


def motion(key: str, *, side: float = 1.0) -> tuple[Array, Array, Array, Array]:
    """Time, voltage, position, velocity of one run: a wheel that follows 2 V per unit/s at once."""
    start = 100.0 - 20.0 * list(RUNS).index(key)  # the last key in the file was recorded first
    way = 1.0 if key.endswith("forward") else -1.0
    steps = np.arange(COUNT)
    voltage = way * (0.1 * steps if key.startswith("slow") else np.where(steps > 0, 6.0, 0.0))
    velocity = side * 0.5 * voltage
    return start + PERIOD * steps, voltage, np.cumsum(velocity) * PERIOD, velocity


def document(width: int, **more: Any) -> dict[str, Any]:
    """A file as a tool wrote it, with rows of this width."""
    rows = {}
    for key in RUNS:
        time, u, x, v = motion(key)
        right = motion(key, side=1.1)
        other, still = np.full(COUNT, 12.5), np.zeros(COUNT)
        rows[key] = {
            4: [time, u, x, v],
            6: [time, other, u / 12, u, x, v],
            9: [time, u, u, x, right[2], v, right[3], still, still],
            10: [time, other, u / 12, u, u, x, right[2], v, right[3], still],
        }[width]
    return {key: np.transpose(columns).tolist() for key, columns in rows.items()} | more


def sysid(width: int, mechanism: str, **more: Any) -> dict[str, Any]:
    """A file of SysId, 2021 to 2023."""
    words = {"test": mechanism, "units": "Meters", "unitsPerRotation": 0.5, "sysid": True}
    return document(width) | words | more


def scaled(made: dict[str, Any], key: str, *columns: int, by: float = -1.0) -> None:
    """Multiply columns of a run."""
    for row in made[key]:
        for column in columns:
            row[column] *= by


def read_json(folder: Path, made: object, **asked: Any) -> Log:
    path = folder / "sysid_data.json"
    path.write_text(made if isinstance(made, str) else json.dumps(made), encoding="utf-8")
    return sim.read(path, **asked)


def only_doubt(log: Log) -> Doubt:
    (doubt,) = log.doubts
    return doubt
