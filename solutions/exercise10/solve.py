"""Exercise 10, answered in both languages: gains as shown, times what their unit asks for.

The gains go into WPILib's class; a comment says what Slot0Configs would take for CONVERSION.
"""

import math
import tomllib
from pathlib import Path

SIZES = {
    "Meters": ("m", 1.0),
    "Feet": ("ft", 0.3048),
    "Inches": ("in", 0.0254),
    "Radians": ("rad", 1.0),
    "Rotations": ("rot", 6.283185307),
    "Degrees": ("deg", 0.01745329252),
}
CLASSES = {
    "Simple": ("SimpleMotorFeedforward", ("kS", "kV", "kA")),
    "Elevator": ("ElevatorFeedforward", ("kS", "kG", "kV", "kA")),
    "Arm": ("ArmFeedforward", ("kS", "kG", "kV", "kA")),
}


def solve(exercise: Path, data: Path) -> dict[str, str]:
    """The files a learner would hand in.

    Args:
        exercise: the exercise's folder, with the files to fill in.
        data: the learner's own data.

    Returns:
        File name -> its text.
    """
    given = tomllib.loads((data / "given.toml").read_text(encoding="utf-8"))
    shown, robot = given["analyzer"], given["robot"]
    made, gains = CLASSES[shown["analysis"]]
    symbol, size = SIZES[robot["units"]]
    times = size / SIZES[shown["units"]][1]
    units = {"kV": f"V·s/{symbol}", "kA": f"V·s²/{symbol}"}
    rows = [("CONVERSION", f"{times:.8g}", f"{shown['units']} in one of {robot['units']}")]
    for gain in gains:
        value = f"{shown[gain]:g}"
        if gain in units:
            value += " * CONVERSION"
        rows.append((gain, value, units.get(gain, "V")))
    duty = robot["loop_output"] == "duty cycle"
    loop = f"{shown['kP']:g} * CONVERSION{' / 12' if duty else ''}"
    rows.append(("kP", loop, "the analyzer's suggestion: start here, then tune"))
    inside = given["motor_controller"]
    turn = 2.0 * math.pi * inside.get("radius", 1.0) / SIZES[shown["units"]][1]
    note = (
        f"Slot0Configs: times {turn:.8g} in place of CONVERSION. Gears {inside['gear_ratio']:g}:1."
    )
    java = (exercise / "ExampleMechanism.java").read_text(encoding="utf-8")
    python = (exercise / "example_mechanism.py").read_text(encoding="utf-8")
    return {
        "ExampleMechanism.java": write_java(java, rows, made, gains, note=note),
        "example_mechanism.py": write_python(python, rows, made, gains, note=note),
    }


Row = tuple[str, str, str]  # name, value, comment


def write_java(text: str, rows: list[Row], made: str, gains: tuple[str, ...], *, note: str) -> str:
    """Fill in the Java file."""
    constants = f"    // {note}\n" + "".join(
        f"    public static final double {name} = {value}; // {said}\n"
        for name, value, said in rows
    )
    arguments = ", ".join(f"CharacterizationConstants.{gain}" for gain in gains)
    field = f"  private final {made} m_feedforward =\n      new {made}({arguments});\n"
    return _fill_in(text, constants, field, mark="//")


def write_python(
    text: str, rows: list[Row], made: str, gains: tuple[str, ...], *, note: str
) -> str:
    """Fill in the Python file."""
    constants = f"    # {note}\n" + "".join(
        f"    {name} = {value}  # {said}\n" for name, value, said in rows
    )
    arguments = ", ".join(f"CharacterizationConstants.{gain}" for gain in gains)
    kind = f"{made}Radians" if made.startswith("Simple") else made
    if "V·s/m" in constants and made.startswith("Simple"):
        kind = f"{made}Meters"
    field = f"        self.feedforward = {kind}({arguments})\n"
    return _fill_in(text, f"from wpimath.controller import {kind}\n", constants, field, mark="#")


def _fill_in(text: str, *parts: str, mark: str) -> str:
    """Put each part where a TODO stands."""
    lines: list[str] = []
    left = list(parts)
    inside = False
    for line in text.splitlines(keepends=True):
        if f"{mark} TODO: " in line:
            lines.append(left.pop(0))
            inside = True
        elif not (inside and line.lstrip().startswith(f"{mark}       ")):
            inside = False
            lines.append(line)
    return "".join(lines)
