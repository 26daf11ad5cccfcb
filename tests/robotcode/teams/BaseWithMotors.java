package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.SubsystemBase;

/** What all rollers of this team have in common. */
public abstract class BaseWithMotors extends SubsystemBase {
  protected static final double STEP = 7.0 / 2;
  protected final TalonFX leader;

  protected BaseWithMotors(int id) {
    leader = new TalonFX(id);
  }

  protected void run(Voltage voltage) {
    leader.setVoltage(voltage.in(Volts));
  }

  protected void describe(SysIdRoutineLog log, String name) {
    log.motor(name).voltage(leader.getMotorVoltage().getValue());
  }
}
