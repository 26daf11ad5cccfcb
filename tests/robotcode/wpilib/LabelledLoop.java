package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.wpilibj.motorcontrol.Talon;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** A loop with a label, which is not run: the grader says so, and judges nothing. */
public class LabelledLoop extends SubsystemBase {
  private final Talon[] m_wheels = {new Talon(0), new Talon(1)};

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(this::drive, null, this));

  private void drive(edu.wpi.first.units.measure.Voltage volts) {
    all: for (Talon wheel : m_wheels) {
      wheel.setVoltage(volts.in(Volts));
      continue all;
    }
  }
}
