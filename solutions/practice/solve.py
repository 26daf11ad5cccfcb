"""Practice, answered without a robot: the code of exercises 4 and 5, and the log's numbers."""

import math
import re
import tomllib
from pathlib import Path

from grader.course.progress import find_course
from grader.exercise.starter import ANSWER
from sim.fit import fit
from sim.io import read

HERE = find_course(Path(__file__).resolve().parent)
LINES = (("exercise4", "ExampleSubsystem.java"), ("exercise5", "RobotContainer.java"),
         ("exercise4", "example_subsystem.py"), ("exercise5", "robotcontainer.py"))  # fmt: skip
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
    return {"answers.toml": text, **fill_in_code(exercise, gains, "m" if diameter else "rot")}


def fill_in_code(exercise: Path, gains: dict[str, float], symbol: str) -> dict[str, str]:
    """The files with robot code, in both languages.

    Args:
        exercise: the exercise's folder, with the files to fill in.
        gains: kS, kV, kA and kP.
        symbol: ``m`` or ``rot``, of the unit that the gains are in.

    Returns:
        File name -> its text.
    """
    routine, buttons, routine_python, buttons_python = (_solve_exercise(*one) for one in LINES)
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
    made = "SimpleMotorFeedforward"
    field = f"  private final {made} m_feedforward =\n      new {made}({arguments});\n"
    bought = f"from wpimath.controller import {kind}\n"
    parts = {
        "ExampleSubsystem.java": (*routine, buttons[1], java, field),
        "RobotContainer.java": (buttons[0], buttons[2]),
        "example_subsystem.py": (
            routine_python[0] + bought,
            *routine_python[1:],
            buttons_python[0],
            python,
            f"        self.feedforward = {kind}({arguments})\n",
        ),
        "robotcontainer.py": (
            "import wpilib\nfrom commands2.sysid import SysIdRoutine\n",
            buttons_python[1],
        ),
    }
    filled = {name: _fill_in(exercise / name, several) for name, several in parts.items()}
    brought = (
        "from commands2.button import CommandXboxController\n"  # what the bindings need beside it
    )
    more = f"import wpilib\n{brought}from commands2.sysid import SysIdRoutine\n"
    filled["robotcontainer.py"] = filled["robotcontainer.py"].replace(brought, more)
    return filled


def _solve_exercise(folder: str, name: str) -> list[str]:
    """The lines between the fences of an authored answer, in the order of their numbers."""
    text = (HERE / "solutions" / folder / name).read_text(encoding="utf-8")
    found = {one["task"][0]: "".join(_remove_comments(one[0])) for one in ANSWER.finditer(text)}
    return [found[number] for number in sorted(found)]


def _remove_comments(block: str) -> list[str]:
    return [line for line in block.splitlines(keepends=True) if " ---" not in line]


def _fill_in(path: Path, parts: tuple[str, ...]) -> str:
    """Put each part where the TODO of its number stands."""
    text = path.read_text(encoding="utf-8")
    for number, part in enumerate(parts, start=1):
        todo = re.compile(
            rf"^[ ]*(?:#|//) TODO: {number}\. .*\n(?:[ ]*(?:#|//)       .*\n)*", re.MULTILINE
        )
        text, count = todo.subn(lambda _, part=part: part, text)
        if count != 1:
            raise ValueError(f"{path.name} has {count} places for its part {number}")
    return text
