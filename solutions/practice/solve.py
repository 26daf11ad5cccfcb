"""Practice, answered without a robot: the files of exercises 4, 5 and 10, and the log's numbers."""

import math
import tomllib
from pathlib import Path

from grader.course import find_course
from sim.fit import fit
from sim.io import read

HERE = find_course(Path(__file__).resolve().parent)
FILES = {
    "exercise4": ("ExampleSubsystem.java", "example_subsystem.py"),
    "exercise5": ("RobotContainer.java", "robotcontainer.py"),
}
OK, WATCH = 8.0, 20.0  # [%] above theory


def solve(exercise: Path, data: Path) -> dict[str, str]:
    """The files a learner would hand in.

    Args:
        exercise: the exercise's folder, with the files to fill in.
        data: the learner's own data.

    Returns:
        File name -> its text.
    """
    given = tomllib.loads((data / "given.toml").read_text(encoding="utf-8"))
    found = fit(read(data / "log.wpilog"), method="sysid").in_log_units()
    gains = {**found.gains, "kP": found.feedback()["velocity"].kp}
    diameter = given.get("wheel_diameter", 0.0)
    per_turn = math.pi * diameter if diameter else 1.0  # [m or rot] for a turn of the output
    theory = 12.0 / (given["free_speed"] / 60.0 / given["ratio"] * per_turn)
    above = 100.0 * (gains["kV"] / theory - 1.0)
    verdict = "bookkeeping" if above < 0 else "ok" if above <= OK else "watch"
    numbers = {
        **gains,
        "simulated_velocity_r2": found.simulated_velocity_r2,
        "kV_theory": theory,
        "difference": above,
    }
    text = (exercise / "answers.toml").read_text(encoding="utf-8")
    for name, value in numbers.items():
        text = text.replace(f'\n{name} = ""', f"\n{name} = {value:.5g}")
    for name, word in (("language", "java"), ("verdict", verdict)):
        text = text.replace(f'{name} = ""', f'{name} = "{word}"')
    solved = {
        name: (HERE / "solutions" / folder / name).read_text(encoding="utf-8")
        for folder, names in FILES.items()
        for name in names
    }
    return {"answers.toml": text, **solved, **_constants(gains, "m" if diameter else "rot")}


def _constants(gains: dict[str, float], symbol: str) -> dict[str, str]:
    """Constants and feedforward, in both languages."""
    units = {
        "kS": "V",
        "kV": f"V·s/{symbol}",
        "kA": f"V·s²/{symbol}",
        "kP": f"V·s/{symbol}, the analyzer's suggestion: start here, then tune",
    }
    java = "".join(
        f"    public static final double {name} = {gains[name]:.5g}; // {said}\n"
        for name, said in units.items()
    )
    python = "".join(f"    {name} = {gains[name]:.5g}  # {said}\n" for name, said in units.items())
    arguments = ", ".join(f"CharacterizationConstants.{name}" for name in ("kS", "kV", "kA"))
    kind = "SimpleMotorFeedforward" + ("Meters" if symbol == "m" else "Radians")
    return {
        "ExampleMechanism.java": f"""\
package frc.robot.subsystems;

import edu.wpi.first.math.controller.SimpleMotorFeedforward;
import edu.wpi.first.wpilibj2.command.SubsystemBase;

public class ExampleMechanism extends SubsystemBase {{
  public static final class CharacterizationConstants {{
{java}  }}

  private final SimpleMotorFeedforward m_feedforward =
      new SimpleMotorFeedforward({arguments});
}}
""",
        "example_mechanism.py": f"""\
from commands2 import Subsystem
from wpimath.controller import {kind}


class CharacterizationConstants:
{python}

class ExampleMechanism(Subsystem):
    def __init__(self) -> None:
        super().__init__()
        self.feedforward = {kind}({arguments})
""",
    }
