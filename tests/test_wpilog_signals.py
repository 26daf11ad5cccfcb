"""WPILOG entries that are named one by one, and their units."""

import math
from pathlib import Path

import numpy as np
import pytest
from wpilog_file import FOUR, Logger, Motor, codes, motion, routine, saved

import sim
from sim.core.errors import BadRequest, MissingSignal
from sim.core.log import Log

METERS = ("volt", "meter", "meters_per_second")


@pytest.mark.parametrize(
    ("late", "state_late"),
    [((0, 0, 0), 0), ((0, 30, 60), 90)],
    ids=["all at one time", "each value at a time of its own"],
)
def test_a_log_of_changes_only_reads_as_the_whole_one(
    tmp_path: Path, late: tuple[int, int, int], state_late: int
) -> None:
    """A step's voltage is logged once there, so SysId's own rule would leave one sample."""
    motor = Motor("main", late=late)
    whole = sim.read(saved(tmp_path, Motor("main"), state_late=state_late))
    changes = sim.read(saved(tmp_path, motor, changes_only=True, state_late=state_late))

    assert codes(changes) == ["change-only"]
    assert [run.test for run in changes.runs] == list(FOUR)
    for ours, theirs in zip(changes.runs, whole.runs, strict=True):
        np.testing.assert_allclose(ours.time, theirs.time + late[2] / 1e6, atol=1e-9)
        assert np.array_equal(ours.voltage, theirs.voltage)
        assert np.array_equal(ours.velocity, theirs.velocity)


def test_slow_sensor_is_not_taken_for_a_log_of_changes(tmp_path: Path) -> None:
    slow = Motor("main", units=METERS, every=(1, 1, 5))
    log = sim.read(saved(tmp_path, slow, tests=("quasistatic-forward",)))

    (run,) = log.runs
    assert codes(log) == ["uneven-rates"]
    v = [motion("quasistatic-forward", loop)[1] for loop in (0, 5)]
    assert run.velocity[2] == pytest.approx(v[0] + (v[1] - v[0]) * 2 / 5)
    assert run.time[-1] == pytest.approx(1.0 + 0.02 * 38)  # the line reaches a little further


def test_values_beyond_the_end_of_a_signal_are_not_invented(tmp_path: Path) -> None:
    """Lines are drawn between samples, not for seconds past the last of them."""
    logger = Logger()
    for name in ("voltage", "position", "velocity"):
        logger.start(f"{name}-m-Arm", "double", {"voltage": "volt"}.get(name, "meter"))
    logger.start("sysid-test-state-Arm", "string")
    for loop in range(100):
        logger.put("voltage-m-Arm", loop * 20_000, 1.0)
        logger.put("position-m-Arm", loop * 20_000, float(loop))
        if loop < 60:
            logger.put("velocity-m-Arm", loop * 20_000, float(loop))
        logger.put("sysid-test-state-Arm", loop * 20_000, "dynamic-forward")

    log = sim.read(logger.save(tmp_path / "log.wpilog"), units="meters")

    assert len(log.runs[0]) == 60
    assert "short-signal" in codes(log)
    assert any("40 of 100 samples" in doubt.message for doubt in log.doubts)


@pytest.mark.parametrize(
    ("leave_out", "expected"),
    [
        (("voltage",), "voltage-main-Arm"),
        (("position", "velocity"), "position-main-Arm"),
        (("voltage", "position", "velocity"), "voltage-<motor>-Arm"),
    ],
)
def test_missing_entry_is_named(tmp_path: Path, leave_out: tuple[str, ...], expected: str) -> None:
    logger = Logger()
    logger.start("/Arm/AppliedVolts")
    logger.put("/Arm/AppliedVolts", 1, 1.0)
    routine(logger, Motor("main", leave_out=leave_out))

    with pytest.raises(MissingSignal) as caught:
        sim.read(logger.save(tmp_path / "log.wpilog"))

    assert caught.value.what.startswith(f"no {expected.partition('-')[0]} entry")
    assert f"'{expected}' (double)" in caught.value.advice
    assert "'/Arm/AppliedVolts'" in caught.value.what


def foreign(tmp_path: Path) -> Path:
    """The log of a logger with names of its own."""
    logger = Logger()
    routine(logger, Motor("main"))
    content = b"".join(logger.parts)
    for ours, theirs in (
        (b"sysid-test-state-Arm", b"/RealOutputs/Arm/Sys"),
        (b"voltage-main-Arm", b"/Arm/AppliedVolt"),
        (b"position-main-Arm", b"/Arm/Encoder/Angle"[:17]),
        (b"velocity-main-Arm", b"/Arm/Encoder/Speed"[:17]),
    ):
        content = content.replace(ours, theirs)
    path = tmp_path / "log.wpilog"
    path.write_bytes(content)
    return path


ENTRIES = {
    "state": "/RealOutputs/Arm/Sys",
    "voltage": "/Arm/AppliedVolt",
    "position": "/Arm/Encoder/Angl",
    "velocity": "/Arm/Encoder/Spee",
}


def test_named_entry_wins_over_one_found(tmp_path: Path) -> None:
    logger = Logger()
    routine(logger, Motor("main"))
    routine(logger, Motor("main", sign=-1), mechanism="Other", begin=1_000_000, tests=FOUR[:1])
    path = logger.save(tmp_path / "log.wpilog")

    log = sim.read(
        path, entries={"voltage": "voltage-main-Other", "state": "sysid-test-state-Other"}
    )

    assert log.runs[0].voltage[-1] < 0
    log = sim.read(path, entries={"voltage": "voltage-main-Arm", "state": "sysid-test-state-Other"})
    assert log.runs[0].voltage[-1] > 0


@pytest.mark.parametrize(
    ("signal", "name"),
    [
        pytest.param("voltage", "/Arm/Applied", id="nearly"),
        pytest.param("velocity", "??", id="not at all"),
        pytest.param("position", "/RealOutputs/Arm/Sys", id="of another type"),
        pytest.param("state", "/Arm/AppliedVolt", id="no string"),
    ],
)
def test_an_entry_that_cannot_be_used_is_refused(tmp_path: Path, signal: str, name: str) -> None:
    with pytest.raises(MissingSignal) as caught:
        sim.read(foreign(tmp_path), entries=ENTRIES | {signal: name})

    assert caught.value.advice


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
def test_unusual_units_are_converted_with_a_warning(
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
