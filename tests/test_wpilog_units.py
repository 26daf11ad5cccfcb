"""Units in WPILOG logs: read in the words of either language, and never silently wrong.

The logs come from the little robot in ``wpilog_file``.
"""

import math
from pathlib import Path

import pytest
from wpilog_file import Motor, codes, motion, saved

import sim
from sim.core.errors import BadRequest
from sim.core.log import Log

METERS = ("volt", "meter", "meters_per_second")


def scales(log: Log) -> tuple[float, float, float]:
    """What the little robot's numbers were multiplied by: voltage, position, velocity."""
    run = log.list_runs_of_test("dynamic-forward")[0]
    x, v = motion("dynamic-forward", 3)
    return run.voltage[3] / 7.0, run.position[3] / x, run.velocity[3] / v


@pytest.mark.parametrize(
    ("units", "name", "position", "velocity"),
    [
        (("Volt", "Meter", "Meter per Second"), "meters", 1.0, 1.0),
        (("Volt", "Foot", "Foot per Second"), "feet", 0.3048, 0.3048),
        (("Volt", "Inch", "Inch per Second"), "inches", 0.0254, 0.0254),
        (("Volt", "Radian", "Radian per Second"), "radians", 1.0, 1.0),
        (("Volt", "Rotation", "Rotation per Second"), "rotations", math.tau, math.tau),
        (("Volt", "Revolution", "Revolution per Second"), "rotations", math.tau, math.tau),
        (("Volt", "Degree", "Degree per Second"), "degrees", math.tau / 360, math.tau / 360),
        (("volt", "meter", "meters_per_second"), "meters", 1.0, 1.0),
        (("volt", "foot", "feet_per_second"), "feet", 0.3048, 0.3048),
        (("volt", "turn", "turns_per_second"), "rotations", math.tau, math.tau),
        (("volt", "radian", "radians_per_second"), "radians", 1.0, 1.0),
        (("VOLTS", "Radians", "RADIANS PER SECOND"), "radians", 1.0, 1.0),
        (("V", "m", "m/s"), "meters", 1.0, 1.0),
        (("V", "rot", "rps"), "rotations", math.tau, math.tau),
        (("V", "rad", " rad/s "), "radians", 1.0, 1.0),
        (('{"unit": "V"}', '{"unit":"deg"}', '{"unit":"deg/s"}'), "degrees", *[math.tau / 360] * 2),
    ],
    ids=lambda value: "/".join(value) if isinstance(value, tuple) else "",
)
def test_units_are_read_in_either_language(
    tmp_path: Path, units: tuple[str, str, str], name: str, position: float, velocity: float
) -> None:
    log = sim.read(saved(tmp_path, Motor("main", units=units)))

    assert log.units == name
    assert log.doubts == ()
    assert scales(log) == pytest.approx((1.0, position, velocity), rel=1e-15)


NOT_STATED = ("", "", "")
TURN = math.tau


@pytest.mark.parametrize(
    ("units", "asked", "expected", "doubts"),
    [
        (("volt", "turn", "rpm"), {}, ("rotations", 1, TURN, TURN / 60), ["converted-units"]),
        (("volt", "turn", "rpm"), {"units": "rotations"}, ("rotations", 1, TURN, TURN / 60),
         ["converted-units"]),
        (("volt", "Degree", "Radian per Second"), {}, ("degrees", 1, TURN / 360, 1),
         ["converted-units"]),
        (("millivolt", *METERS[1:]), {}, ("meters", 0.001, 1, 1), ["converted-units"]),
        (("volt", "millimeter", METERS[2]), {}, ("meters", 1, 0.001, 1), ["converted-units"]),
        (METERS, {"units": "inches"}, ("inches", 1, 0.0254, 0.0254), ["contradicting-units"]),
        (NOT_STATED, {"type": "simple"}, ("meters", 1, 1, 1), ["units-assumed"] * 2),
        (NOT_STATED, {}, ("radians", 1, 1, 1), ["units-assumed"] * 2),  # it is named an arm
        (NOT_STATED, {"type": "arm"}, ("radians", 1, 1, 1), ["units-assumed"] * 2),
        (NOT_STATED, {"units": "feet"}, ("feet", 1, 0.3048, 0.3048), []),
        (("", "turn", ""), {}, ("rotations", 1, TURN, TURN), ["units-assumed"]),
        (("", "", "turns_per_second"), {}, ("rotations", 1, TURN, TURN), ["units-assumed"]),
        (("percent", "furlong", "{broken"), {"units": "feet"}, ("feet", 1, 0.3048, 0.3048),
         ["unknown-unit"] * 2),
    ],
)  # fmt: skip
def test_odd_units_are_converted_with_a_doubt(
    tmp_path: Path,
    units: tuple[str, str, str],
    asked: dict[str, str],
    expected: tuple[str, float, float, float],
    doubts: list[str],
) -> None:
    log = sim.read(saved(tmp_path, Motor("main", units=units)), **asked)

    name, *factors = expected
    assert log.units == name
    assert scales(log) == pytest.approx(tuple(factors), rel=1e-14)
    assert codes(log) == doubts
    assert all("main-Arm" in doubt.message for doubt in log.doubts)


def test_an_angle_and_a_length_do_not_go_together(tmp_path: Path) -> None:
    path = saved(tmp_path, Motor("main", units=("volt", "turn", "meters_per_second")))

    with pytest.raises(BadRequest, match=r"'turn'.*'meters_per_second'.*--units"):
        sim.read(path)
    assert codes(sim.read(path, units="meters")) == ["contradicting-units"]


def test_motors_in_an_angle_and_in_a_length_do_not_go_together(tmp_path: Path) -> None:
    path = saved(tmp_path, Motor("left"), Motor("right", units=METERS))

    with pytest.raises(BadRequest, match=r"rotations, 'right' in meters.*--motor left"):
        sim.read(path)


def test_motors_in_two_units_of_a_kind_are_converted(tmp_path: Path) -> None:
    inches = ("Volt", "Inch", "Inch per Second")
    log = sim.read(saved(tmp_path, Motor("a", units=METERS), Motor("b", units=inches)))

    assert log.units == "meters"
    assert scales(log) == pytest.approx((1.0, (1 + 0.0254) / 2, (1 + 0.0254) / 2))
