package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** What it drives is for another class to say. */
public abstract class AbstractMechanism extends SubsystemBase {
  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(this::setVoltage, this::writeLog, this));

  protected abstract void setVoltage(Voltage voltage);

  protected abstract void writeLog(SysIdRoutineLog log);
}
