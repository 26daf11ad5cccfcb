"""Numbers of a Config, and what they come to: arithmetic, units, constants from anywhere."""

from pathlib import Path

import pytest
from robot_phrase import java, python

from grader.robotcode.facts import Certainty

JAVA_CONSTANTS = {  # an argument, the fields it needs, what it is
    "volts": ("Volts.of(3.5)", "", (3.5, "volts")),
    "a bare fraction": ("Volts.of(.5)", "", (0.5, "volts")),
    "a bare point": ("Volts.of(2.)", "", (2.0, "volts")),
    "an exponent": ("Volts.of(35e-1)", "", (3.5, "volts")),
    "float": ("Volts.of(.5f)", "", (0.5, "volts")),
    "long": ("Volts.of(3L)", "", (3.0, "volts")),
    "hexadecimal": ("Volts.of(0x0B)", "", (11.0, "volts")),
    "octal": ("Volts.of(010)", "", (8.0, "volts")),
    "underscores": ("Millivolts.of(3_500)", "", (3.5, "volts")),
    "Units in front": ("Units.Volts.of(3)", "", (3.0, "volts")),
    "package in front": ("edu.wpi.first.units.Units.Volts.of(3)", "", (3.0, "volts")),
    "per second": ("Volts.of(.5).per(Second)", "", (0.5, "volts-per-second")),
    "per seconds": ("Volts.of(.5).per(Seconds)", "", (0.5, "volts-per-second")),
    "per minute": ("Volts.of(30).per(Minute)", "", (0.5, "volts-per-second")),
    "unit first": ("Volts.per(Second).of(.5)", "", (0.5, "volts-per-second")),
    "divided by a time": ("Volts.of(1).div(Seconds.of(2))", "", (0.5, "volts-per-second")),
    "milliseconds": ("Units.Milliseconds.of(2_500)", "", (2.5, "seconds")),
    "minutes": ("Minutes.of(.5)", "", (30.0, "seconds")),
    "another kind": ("Meters.of(2)", "", (2.0, "other")),
    "a plain number": ("3.5", "", (3.5, "number")),
    "taken out of its unit": ("Volts.of(3).in(Millivolts)", "", (3000.0, "number")),
    "integers divide": ("Volts.of(7 / 2)", "", (3.0, "volts")),
    "a quarter": ("Volts.of(1 / 4)", "", (0.0, "volts")),
    "towards zero": ("Volts.of(-7 / 2)", "", (-3.0, "volts")),
    "one real is enough": ("Volts.of(7.0 / 2)", "", (3.5, "volts")),
    "cast before division": ("Volts.of((double) 7 / 2)", "", (3.5, "volts")),
    "cast after division": ("Volts.of((double) (7 / 2))", "", (3.0, "volts")),
    "cast to int": ("Volts.of((int) 3.9)", "", (3.0, "volts")),
    "remainder": ("Volts.of(-7 % 4)", "", (-3.0, "volts")),
    "signs": ("Volts.of(-(-3) + +1)", "", (4.0, "volts")),
    "times": ("Volts.of(7).times(.5)", "", (3.5, "volts")),
    "plus and minus": ("Volts.of(4).plus(Volts.of(1)).minus(Volts.of(2))", "", (3.0, "volts")),
    "negated": ("Volts.of(3).unaryMinus()", "", (-3.0, "volts")),
    "one of it": ("Volts.one().times(4)", "", (4.0, "volts")),
    "boxed": ("Volts.of(Double.valueOf(3.5))", "", (3.5, "volts")),
    "cast": ("(Voltage) Volts.of(3)", "", (3.0, "volts")),
    "a constant": ("Volts.of(kStep)", "static final double kStep = 3.5;", (3.5, "volts")),
    "this": ("Volts.of(this.step)", "private final double step = 3.5;", (3.5, "volts")),
    "a measure": ("kStep", "static final Voltage kStep = Volts.of(3.5);", (3.5, "volts")),
    "an int": ("Volts.of(k / 2)", "static final int k = 7;", (3.0, "volts")),
    "an int kept as double": ("Volts.of(k / 2)", "static final double k = 7;", (3.5, "volts")),
    "a double from ints": ("Volts.of(k)", "static final double k = 7 / 2;", (3.0, "volts")),
    "nested": (
        "Volts.of(K.a.b)",
        "static class K {static class a {static int b = 3;}}",
        (3, "volts"),
    ),
    "a method": ("step()", "static Voltage step() { return Volts.of(3.5); }", (3.5, "volts")),
    "a real method": ("Volts.of(k() / 2)", "double k() { return 7; }", (3.5, "volts")),
    "null by name": ("kNone", "static final Voltage kNone = null;", "default"),
    "null": ("null", "", "default"),
    "set twice": ("Volts.of(k)", "double k = 3; void f() { k = 4; }", "unknown"),
    "in a circle": ("Volts.of(a)", "double a = b; double b = a;", "unknown"),
    "a choice": ("fast ? Volts.of(7) : Volts.of(3)", "", "unknown"),
    "a foreign call": ("Volts.of(Preferences.getDouble(key, 3))", "", "unknown"),
    "not here": ("Volts.of(Constants.kStep)", "", "unknown"),
    "by zero": ("Volts.of(1 / 0)", "", "unknown"),
    "overflow": ("Volts.of(2_147_483_647 + 1)", "", "unknown"),
    "no amount": ("Volts", "", "unknown"),
    "apples and pears": ("Volts.of(3).plus(Seconds.of(1))", "", "unknown"),
    "text": ('Volts.of("3")', "", "unknown"),
}


@pytest.mark.parametrize("case", JAVA_CONSTANTS)
def test_a_java_constant_is_worked_out_as_java_does_it(case: str, tmp_path: Path) -> None:
    step, fields, expected = JAVA_CONSTANTS[case]

    found = java(tmp_path, step=step, fields=fields).step

    if isinstance(expected, str):
        assert found.known.value == expected
    else:
        assert (found.known, found.dimension) == (Certainty.STATED, expected[1])
        assert found.value == pytest.approx(expected[0], rel=1e-12)
    assert found.text == step


PYTHON_CONSTANTS = {  # an argument, where it is defined, what it is
    "a number": ("3.5", {}, 3.5),
    "an integer": ("3", {}, 3.0),
    "division": ("7 / 2", {}, 3.5),
    "floor": ("7 // 2", {}, 3.0),
    "at the top": ("STEP", {"top": "STEP = 7 * 0.5"}, 3.5),
    "in the class": ("self.STEP", {"fields": "STEP = 3.5"}, 3.5),
    "by the class": ("Arm.STEP", {"fields": "STEP = 3.5"}, 3.5),
    "set in init": ("self.step", {"body": "self.step = 3.5"}, 3.5),
    "a local": ("step", {"body": "step = 3.5"}, 3.5),
    "a local hides the top": ("step", {"top": "step = 9", "body": "step = 3.5"}, 3.5),
    "volts": ("volts(3.5)", {}, 3.5),
    "converted": ("millisecondsToSeconds(3500)", {}, 3.5),
    "the class does not see it": ("STEP", {"fields": "STEP = 3.5"}, None),
    "set twice": ("step", {"body": "step = 3; step = 4"}, None),
    "None": ("None", {}, None),
    "a power": ("10 ** 10 ** 10", {}, None),
    "too large": ("1e999", {}, None),
    "not here": ("constants.STEP", {"top": "import constants"}, None),
}


@pytest.mark.parametrize("case", PYTHON_CONSTANTS)
def test_a_python_constant_is_worked_out_as_python_does_it(case: str, tmp_path: Path) -> None:
    step, places, value = PYTHON_CONSTANTS[case]

    found = python(tmp_path, step=step, **places).step

    assert found.value == value
    assert found.dimension == ("" if value is None else "number")
    assert found.text == step


def test_two_files_of_one_name_are_told_apart_by_their_package_or_not_at_all(
    tmp_path: Path,
) -> None:
    for package in ("left", "right"):
        (tmp_path / package).mkdir()
        (tmp_path / package / "Constants.java").write_text(
            f"package {package}; class Constants {{ static double k = {len(package)}; }}",
            encoding="utf-8",
        )

    assert java(tmp_path, step="Volts.of(right.Constants.k)").step.value == 5.0
    assert java(tmp_path, step="Volts.of(Constants.k)").step.known is Certainty.UNKNOWN


def test_a_damaged_neighbor_has_no_constants(tmp_path: Path) -> None:
    text = "class Constants { static double k = 3.5; int x = (; }"
    (tmp_path / "Constants.java").write_text(text, encoding="utf-8")

    assert java(tmp_path, step="Volts.of(Constants.k)").step.known is Certainty.UNKNOWN
