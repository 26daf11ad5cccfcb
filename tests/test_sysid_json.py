"""JSON of the tools of 2019 to 2023: every form of row, and what the file says of itself."""

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from old_tools import RUNS, document, motion, read_json, scaled, sysid

import sim


@pytest.mark.parametrize(
    ("test", "type_"),
    [
        ("Simple", "simple"),
        ("Simple Motor", "simple"),
        ("Elevator", "elevator"),
        ("Arm", "arm"),
    ],
)
def test_rows_of_four_are_one_mechanism(tmp_path: Path, test: str, type_: str) -> None:
    log = read_json(tmp_path, sysid(4, test))

    assert (log.type, log.mechanism, log.units) == (type_, test, "meters")
    assert log.doubts == ()
    # In the order they were recorded, which is not that of the file.
    assert [run.test for run in log.runs] == list(RUNS.values())[::-1]
    for key, name in RUNS.items():
        time, voltage, position, velocity = motion(key)
        (run,) = log.list_runs_of_test(name)
        assert run.time.tolist() == time.tolist()
        assert run.voltage.tolist() == voltage.tolist()
        assert run.position.tolist() == (position * 0.5).tolist()
        assert run.velocity.tolist() == (velocity * 0.5).tolist()
        assert run.bus_voltage is None


@pytest.mark.parametrize(
    ("asked", "units"),
    [
        pytest.param({"units": "feet"}, "feet", id="as said"),
        pytest.param({"type": "arm"}, "radians", id="an arm's default"),
    ],
)
def test_units_a_file_leaves_open_are_settled_by_asking(
    tmp_path: Path, asked: dict[str, str], units: str
) -> None:
    log = read_json(tmp_path, document(6), **asked)

    assert log.units == units
    assert [doubt.code for doubt in log.doubts] == ([] if "units" in asked else ["units-unknown"])


@pytest.mark.parametrize("motor", [None, "left", "right", "combined"])
@pytest.mark.parametrize("width", [9, 10])
def test_a_drivetrain_is_the_mean_of_its_sides_or_the_one_asked_for(
    tmp_path: Path, width: int, motor: str | None
) -> None:
    log = read_json(tmp_path, sysid(width, "Drivetrain"), motor=motor)

    assert (log.type, log.mechanism) == ("simple", "Drivetrain")
    assert log.doubts == ()
    assert len(log.runs) == 4
    share = {"left": 1.0, "right": 1.1}.get(motor or "", 1.05)
    for key, name in RUNS.items():
        time, voltage, position, velocity = motion(key)
        (run,) = log.list_runs_of_test(name)
        assert run.time.tolist() == time.tolist()
        assert run.voltage.tolist() == voltage.tolist()
        np.testing.assert_allclose(run.position, share * 0.5 * position, rtol=1e-14)
        np.testing.assert_allclose(run.velocity, share * 0.5 * velocity, rtol=1e-14)
        assert (run.bus_voltage is None) == (width == 9)


def test_a_row_of_ten_of_an_elevator_is_one_mechanism(tmp_path: Path) -> None:
    made = document(10, test="Elevator", units="Feet")
    for key in RUNS:
        scaled(made, key, 4, 6, 8, by=0.0)

    log = read_json(tmp_path, made)

    assert log.type == "elevator"
    assert log.list_runs_of_test("dynamic-forward")[0].voltage[-1] == 6.0
    assert log.doubts == ()


def test_the_nine_columns_of_2019_are_told_from_those_of_sysid_by_the_battery(
    tmp_path: Path,
) -> None:
    made = {key: [row[:9] for row in rows] for key, rows in document(10).items()}

    (run,) = read_json(tmp_path, made, motor="left").list_runs_of_test("dynamic-forward")
    assert run.voltage[-1] == 6.0
    assert run.bus_voltage is not None
    assert run.bus_voltage[-1] == 12.5

    (run,) = read_json(tmp_path, document(9), motor="left").list_runs_of_test("dynamic-forward")
    assert run.voltage[-1] == 6.0
    assert run.bus_voltage is None


def test_empty_and_unknown_runs_are_left_out(tmp_path: Path) -> None:
    made = sysid(4, "Simple") | {"slow-forward": [], "fast_forward": [[1, 2, 3, 4]]}

    assert len(read_json(tmp_path, made).runs) == 3


class Real(NamedTuple):
    """What can be checked of a real log by hand."""

    name: str
    type: str
    units: str
    span: float  # [s] of the four tests together
    reach: float  # [m or rad] from the lowest position to the highest
    highest: float  # [V] the largest voltage


REAL = [
    Real("sciborgs-2023-elbow-arm", "arm", "radians", 19.9, 5.3, 2.6),
    Real("sciborgs-2023-wrist-arm", "arm", "radians", 22.5, 4.9, 1.8),
    Real("sciborgs-2023-elevator", "elevator", "meters", 33.5, 0.45, 3.4),
    Real("frc4646-2022-drivetrain", "simple", "meters", 21.8, 4.1, 7.0),
    Real("frc501-2020-drivetrain", "simple", "meters", 25.9, 6.3, 6.2),
]


@pytest.mark.shared
@pytest.mark.parametrize("real", REAL, ids=lambda real: real.name)
def test_a_real_log_reads_whole(shared: Path, real: Real) -> None:
    log = sim.read(shared / "data" / "real" / f"{real.name}.json")

    assert (log.type, log.units) == (real.type, real.units)
    assert sorted(run.test for run in log.runs) == sorted(RUNS.values())
    assert sum(np.ptp(run.time) for run in log.runs) == pytest.approx(real.span, abs=0.1)
    positions = np.concatenate([run.position for run in log.runs])
    assert np.ptp(positions) == pytest.approx(real.reach, rel=0.03)
    voltages = np.concatenate([run.voltage for run in log.runs])
    assert np.abs(voltages).max() == pytest.approx(real.highest, rel=0.03)
    assert [doubt.code for doubt in log.doubts] == ["units-unknown"] * ("2020" in real.name)
