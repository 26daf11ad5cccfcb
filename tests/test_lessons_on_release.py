"""What lessons 2, 4 and 5 say about the end of a test, shown by WPILib's own routine."""

import json
import subprocess
import sys

import pytest

PROGRAM = """
import json
import pathlib

from commands2 import CommandScheduler, RunCommand, Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import DriverStation
from wpilib.simulation import DriverStationSim

did = []
lift = Subsystem()
lift.setDefaultCommand(RunCommand(lambda: did.append("default"), lift))
routine = SysIdRoutine(
    SysIdRoutine.Config(), SysIdRoutine.Mechanism(did.append, lambda log: None, lift)
)
DriverStationSim.setEnabled(True)
DriverStationSim.notifyNewData()
DriverStation.refreshData()
test = routine.dynamic(SysIdRoutine.Direction.kForward)
test.schedule()
for _ in range(4):
    CommandScheduler.getInstance().run()
test.cancel()
CommandScheduler.getInstance().run()
CommandScheduler.getInstance().run()
pathlib.Path("did.json").write_text(json.dumps(did), encoding="utf-8")  # WPILib prints, too
"""


def test_a_test_that_is_let_go_ends_with_0_volts_and_the_default_command_takes_over(tmp_path):
    pytest.importorskip("commands2", reason="RobotPy is not installed")
    program = tmp_path / "program.py"
    program.write_text(PROGRAM, encoding="utf-8")

    subprocess.run([sys.executable, program], cwd=tmp_path, check=True, timeout=60)

    did = json.loads((tmp_path / "did.json").read_text(encoding="utf-8"))
    assert 7.0 in did
    end = did.index(0.0)
    assert "default" not in did[:end]
    assert did[end + 1 :]
    assert set(did[end + 1 :]) == {"default"}
