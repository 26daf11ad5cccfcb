"""Exercise 2, answered: one line of arithmetic, and two tables read side by side."""

import math
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

UPPER = ((0.0, "bookkeeping"), (8.0, "ok"), (20.0, "watch"), (math.inf, "inspect"))  # [%]


def solve(exercise: Path, data: Path) -> dict[str, str]:
    """The files a learner would hand in.

    Args:
        exercise: the exercise's folder, with the file to fill in.
        data: the learner's own data.

    Returns:
        File name -> its text.
    """
    given = tomllib.loads((data / "given.toml").read_text(encoding="utf-8"))
    parts, log = given["parts"], given["log"]
    turns = parts["free_speed"] / 60.0 / parts["ratio"]
    theory = 12.0 / (turns * math.pi * _read_diameter(parts, 1.0 / math.pi))
    percent = 100.0 * (log["kV"] / theory - 1.0)
    answers = {
        "kV_theory": f"{theory:.5g}",
        "difference": f"{percent:.2f}",
        "verdict": f'"{next(word for upper, word in UPPER if percent <= upper)}"',
        "ks_flag": f'"{_judge_friction(log)}"',
    }
    text = (exercise / "answers.toml").read_text(encoding="utf-8")
    for name, value in answers.items():
        text = text.replace(f'{name} = ""', f"{name} = {value}")
    listed = ", ".join(f'"{one}"' for one in _list_causes(given, below=percent < 0.0))
    return {"answers.toml": text.replace("inspection = []", f"inspection = [{listed}]")}


def _read_diameter(parts: Mapping[str, Any], otherwise: float) -> float:
    return float(parts.get("wheel_diameter", parts.get("drum_diameter", otherwise)))


def _judge_friction(log: Mapping[str, float]) -> str:
    if log["kS"] > log["kV"] * log["typical_speed"]:
        return "stop"
    return "watch" if log["kS"] > 0.5 else "fine"


def _list_causes(given: Mapping[str, Any], *, below: bool) -> list[str]:
    """What the file shows first, then what else is possible and not ruled out by the file."""
    parts, code, mechanic = given["parts"], given["code"], given["noticed"]["mechanic"]
    radius = code.get("radius", 0.0)
    if code["ratio"] != parts["ratio"]:
        return ["gear-ratio", "motor-type"]
    if not math.isclose(2.0 * radius, _read_diameter(parts, 0.0), rel_tol=0.01, abs_tol=1e-9):
        return ["wheel-size", "motor-type"]
    if "commanded" in code["logged_voltage"]:
        return ["logged-voltage", "motor-type"]
    if "hot to touch" in mechanic:
        return ["dry-bearing" if "bearing" in mechanic else "dragging-belt", "motor-type"]
    if below:
        raise ValueError("kV is below theory, and no line of the file says why")
    return ["gear-ratio", "logged-voltage", "dragging-belt"]
