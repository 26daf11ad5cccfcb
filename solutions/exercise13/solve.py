"""Exercise 13, answered: two fits, a spin, a push against a wall, and some arithmetic."""

import csv
import math
import tomllib
from pathlib import Path

from sim.fit import fit
from sim.io import read, read_motors

ENTRIES = {
    "voltage": "Phoenix6/TalonFX-1/MotorVoltage",
    "position": "Phoenix6/Pigeon2-1/Yaw",
    "velocity": "Phoenix6/Pigeon2-1/AngularVelocityZWorld",
}


def solve(exercise: Path, data: Path) -> dict[str, str]:
    """The files a learner would hand in.

    Args:
        exercise: the exercise's folder, with the file to fill in.
        data: the learner's own data.

    Returns:
        File name -> its text.
    """
    given = tomllib.loads((data / "given.toml").read_text(encoding="utf-8"))
    robot, spin = given["robot"], given["spin"]
    modules = read_motors(data / "straight.wpilog")
    kv = {name: fit(log, method="sysid").gains["kV"] for name, log in modules.items()}
    worn = min(kv, key=lambda name: kv[name])
    sound = next(log for name, log in modules.items() if name != worn)
    straight = fit(sound).gains
    turning = fit(read(data / "turning.wpilog", entries=ENTRIES)).in_units("radians").gains
    lever = robot["trackwidth"] / math.sqrt(2.0)
    wheel_turns = spin["motor_turns"][worn] / robot["ratio"]
    slip = _measure_slip_current(data / "push.csv")
    numbers = {
        "kS": straight["kS"],
        "kV": straight["kV"],
        "kA": straight["kA"],
        "worn_radius": math.radians(spin["gyro"]) * lever / (2.0 * math.pi * wheel_turns),
        "lever": lever,
        "kA_turning": turning["kA"],
        "inertia": robot["mass"] * lever * turning["kA"] / straight["kA"],
        "slip_current": slip,
        "top_speed": (12.0 - straight["kS"]) / straight["kV"],
        "max_torque": robot["stall_torque"] * slip / robot["stall_current"],
    }
    text = (exercise / "answers.toml").read_text(encoding="utf-8")
    for name, value in numbers.items():
        text = text.replace(f'{name} = ""', f"{name} = {value:.5g}")
    for name, word in (("worn", worn), ("rate_unit", "radians-per-second")):
        text = text.replace(f'{name} = ""', f'{name} = "{word}"')
    return {"answers.toml": text}


def _measure_slip_current(path: Path) -> float:
    """[A] in the last row before the wheels turn."""
    with path.open(encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    first = next(k for k, row in enumerate(rows) if float(row["wheel_velocity"]) > 0.0)
    return float(rows[first - 1]["stator_current"])
