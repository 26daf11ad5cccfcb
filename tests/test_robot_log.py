"""RobotPy and this project read each other: a real SysIdRoutine's log, and every record of ours."""

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from wpilog_file import FOUR, records

import sim
from sim.core.log import Log, Run
from sim.fit import fit
from sim.io.formats.wpilog.contents import read_contents

pytestmark = pytest.mark.robot

KS, KV, KA = 0.18, 0.118, 0.02  # of the simulated flywheel: [V], [V/(rot/s)], [V/(rot/s²)]
LONGEST = 120  # [s] a robot program that takes longer hangs


@pytest.fixture(scope="module")
def robot_log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What WPILib's own logger leaves when its simulation runs the four tests."""
    pytest.importorskip("commands2", reason="RobotPy is not installed (extra `robot`)")
    folder = tmp_path_factory.mktemp("robot")
    program = Path(__file__).with_name("robot_routine.py")
    plant = [str(gain) for gain in (KS, KV, KA)]
    done = subprocess.run(
        [sys.executable, str(program), str(folder), "log.wpilog", *plant],
        cwd=folder,  # the simulation leaves files of its own
        env={**os.environ, "PYTHONWARNINGS": "error"},
        capture_output=True,
        timeout=LONGEST,
        check=False,
    )
    assert done.returncode == 0, done.stderr.decode(errors="replace")
    return folder / "log.wpilog"


@pytest.fixture(scope="module")
def log(robot_log: Path) -> Log:
    return sim.read(robot_log)


def test_log_of_a_real_routine_is_read_as_its_four_runs(log: Log) -> None:
    assert (log.mechanism, log.units) == ("Fly-Wheel", "rotations")
    assert log.doubts == ()
    assert [run.test for run in log.runs] == list(FOUR)
    for run, expected in zip(log.runs, (499, 499, 99, 99), strict=True):
        assert abs(len(run) - expected) <= 1  # the timeout falls on the edge of a loop
        np.testing.assert_allclose(np.diff(run.time), 0.02, atol=2e-6)


def test_a_real_routine_gives_the_gains_of_its_plant(log: Log) -> None:
    gains = fit(log, type="simple", method="sysid").gains

    assert gains["kV"] == pytest.approx(KV / (2 * math.pi), rel=0.01)
    assert gains["kA"] == pytest.approx(KA / (2 * math.pi), rel=0.10)
    assert gains["kS"] == pytest.approx(KS, rel=0.15)


def ours(path: Path) -> dict[str, tuple[str, str, list[int], list[object]]]:
    """Every entry of a file by this project's reader: type, metadata, times, values."""
    return {
        entry.name: (
            entry.type,
            entry.metadata,
            entry.time.tolist(),
            entry.texts() if entry.type in {"string", "json"} else entry.numbers().tolist(),
        )
        for entry in read_contents(path).list_entries()
    }


def theirs(path: Path) -> dict[str, tuple[str, str, list[int], list[object]]]:
    """The same by WPILib's own reader."""
    log = pytest.importorskip("wpiutil.log", reason="RobotPy is not installed (extra `robot`)")
    getters = {
        "double": "getDouble",
        "float": "getFloat",
        "int64": "getInteger",
        "boolean": "getBoolean",
        "string": "getString",
        "json": "getString",
    }
    found: dict[int, tuple[str, str, str, list[int], list[object]]] = {}
    reader = log.DataLogReader(str(path))
    assert reader.isValid()
    for one in reader:
        if one.isStart():
            data = one.getStartData()
            found[data.entry] = (data.name, data.type, data.metadata, [], [])
        elif not one.isControl():
            _, kind, _, times, values = found[one.getEntry()]
            times.append(one.getTimestamp())
            values.append(getattr(one, getters[kind])())
    return {name: tuple(rest) for name, *rest in found.values()}


def test_wpilibs_reader_gets_the_values_that_sim_wrote(tmp_path: Path) -> None:
    rng = np.random.default_rng(7)
    runs = [
        Run(test, 60.0 * k + np.cumsum(rng.uniform(0.005, 0.03, 200)), *rng.normal(size=(4, 200)))
        for k, test in enumerate(FOUR)
    ]
    path = tmp_path / "log.wpilog"
    sim.write(Log(tuple(runs), units="degrees", mechanism="Árm-2"), path)

    expected = theirs(path)

    assert ours(path) == expected
    assert sum(len(times) for _, _, times, _ in expected.values()) + 5 == len(
        list(records(path.read_bytes()))
    )
    assert expected["voltage-árm-2-Árm-2"][3][:200] == runs[0].voltage.tolist()
