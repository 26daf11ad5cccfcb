package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.CANcoder;
import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** The request's public field is set, instead of calling withOutput. */
public class Pivot extends SubsystemBase {
  private final TalonFX m_pivot = new TalonFX(31);
  private final CANcoder m_cancoder = new CANcoder(32);
  private final VoltageOut m_sysIdControl = new VoltageOut(0);
  private final SysIdRoutine m_sysId;

  public Pivot() {
    m_sysId = new SysIdRoutine(
        new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(2), Seconds.of(4)),
        new SysIdRoutine.Mechanism(this::applyVoltage, this::writeLog, this, "pivot"));
  }

  private void applyVoltage(Voltage voltage) {
    m_sysIdControl.Output = voltage.in(Volts);
    m_pivot.setControl(m_sysIdControl);
  }

  private void writeLog(SysIdRoutineLog log) {
    log.motor("pivot")
        .voltage(m_pivot.getMotorVoltage().getValue())
        .angularPosition(m_cancoder.getAbsolutePosition().getValue())
        .angularVelocity(m_cancoder.getVelocity().getValue());
  }
}
