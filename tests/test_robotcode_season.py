"""Names of two seasons: both are read, and a program tells which of them it is written for."""

import pytest

from grader.robotcode import bench, read
from grader.robotcode.bench.season import explain_other_season
from grader.robotcode.facts import Output, Source
from grader.robotcode.vocabulary import find_season_of

JAVA = """
package first.robot;

import org.wpilib.command2.SubsystemBase;
import org.wpilib.command2.sysid.SysIdRoutine;
import org.wpilib.hardware.motor.PWMSparkMax;
import org.wpilib.system.RobotController;
import static org.wpilib.units.Units.*;

public class Wheel extends SubsystemBase {
  private final PWMSparkMax m_motor = new PWMSparkMax(0);
  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(
          volts -> m_motor.setThrottle(volts.in(Volts) / 12),
          log -> log.motor("wheel").voltage(
              Volts.of(m_motor.getThrottle() * RobotController.getBatteryVoltage())),
          this));

  public Object forward() {
    return m_routine.dynamic(SysIdRoutine.Direction.FORWARD);
  }
}
"""
PYTHON = """
from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import PWMSparkMax, RobotController


class Wheel(Subsystem):
    def __init__(self):
        super().__init__()
        self.motor = PWMSparkMax(0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(ramp_rate=0.5, step_voltage=3.5, timeout=10),
            SysIdRoutine.Mechanism(self.drive, self.record, self),
        )

    def drive(self, voltage):
        self.motor.set_throttle(voltage / 12)

    def record(self, log):
        volts = self.motor.get_throttle() * RobotController.get_battery_voltage()
        log.motor("wheel").voltage(volts)
"""


@pytest.mark.parametrize(("name", "text"), [("Wheel.java", JAVA), ("wheel.py", PYTHON)])
def test_the_names_of_2027_are_read_like_those_before(tmp_path, name, text):
    path = tmp_path / name
    path.write_text(text, "utf-8")
    facts = read(path)

    assert [one.value for one in (facts.ramp, facts.step, facts.timeout)] == [0.5, 3.5, 10]
    assert [(one.output, one.scaled) for one in facts.drive] == [(Output.DUTY, True)]
    assert [(one.signal, one.source) for one in facts.logged] == [("voltage", Source.APPLIED)]


GONE = {  # what a program of 2027 no longer has -> what it has instead
    "set": ("setThrottle(", "set("),
    "get": ("getThrottle(", "get("),
    "kForward": ("Direction.FORWARD", "Direction.kForward"),
}


@pytest.mark.parametrize("gone", GONE)
def test_a_name_that_2027_no_longer_has_is_a_compile_error_there_alone(tmp_path, gone):
    new, old = GONE[gone]
    assert new in JAVA
    of_2027 = JAVA.replace(new, old)
    of_2026 = (
        of_2027.replace("org.wpilib.command2", "edu.wpi.first.wpilibj2.command")
        .replace("org.wpilib.hardware.motor", "edu.wpi.first.wpilibj.motorcontrol")
        .replace("org.wpilib.system", "edu.wpi.first.wpilibj")
    )
    found = {}
    for season, text in ((2027, of_2027), (2026, of_2026.replace("org.wpilib", "edu.wpi.first"))):
        path = tmp_path / str(season) / "Wheel.java"
        path.parent.mkdir()
        path.write_text(text, "utf-8")
        said = "".join(one.message for one in read(path).compile_errors)
        found[season] = f"WPILib 2027 has no {gone} here. Did you mean" in said

    assert found == {2027: True, 2026: False}


@pytest.mark.parametrize(("package", "refused"), [("org.wpilib", True), ("edu.wpi.first", False)])
def test_a_can_bus_by_its_name_is_a_compile_error_in_2027(tmp_path, package, refused):
    path = tmp_path / "Lift.java"
    path.write_text(
        f"""package frc.robot;
import {package}.units.measure.Voltage;
import com.ctre.phoenix6.hardware.TalonFX;
import com.ctre.phoenix6.CANBus;
import {"org.wpilib.command2" if refused else "edu.wpi.first.wpilibj2.command"}.sysid.SysIdRoutine;

public class Lift {{
  private final TalonFX m_named = new TalonFX(1, "canivore");
  private final TalonFX m_right = new TalonFX(2, new CANBus("canivore"));
  private final SysIdRoutine m_routine = new SysIdRoutine(null, null);
}}
""",
        "utf-8",
    )

    found = [(one.line, one.message) for one in read(path).compile_errors]

    said = "for WPILib 2027, TalonFX takes a CANBus, and no text: new CANBus(...)"
    assert found == ([(8, said)] if refused else [])


@pytest.mark.parametrize(
    ("name", "season"),
    [
        ("set_voltage", "2027"),  # RobotPy's snake case, and its constants in capitals
        ("ramp_rate", "2027"),
        ("FORWARD", "2027"),
        ("set_throttle", "2027"),  # what WPILib called set until then
        ("setThrottle", "2027"),
        ("setVoltage", "2026"),
        ("rampRate", "2026"),
        ("kForward", "2026"),
        ("set", ""),
        ("forward", ""),
        ("my_own", ""),
    ],
)
def test_a_name_tells_its_season(name, season):
    assert find_season_of(name) == season


def test_an_import_of_another_season_is_known_by_the_names_beside_it():
    error = "ImportError: cannot import name 'PIDController' from 'wpimath'"
    season = "2027" if bench.is_robotpy_installed() else ""

    assert season in explain_other_season(error, "self.motor.set_voltage(3)")
    assert explain_other_season(error, "self.motor.go(3)") == ""
