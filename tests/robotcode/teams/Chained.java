package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog.MotorLog;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** The voltage goes through three methods and a field before it reaches the motor. */
public class Chained extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(5);
  private Voltage m_asked = Volts.zero();

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(this::ask, this::write, this));

  private void ask(Voltage voltage) {
    m_asked = voltage;
    apply();
  }

  private void apply() {
    push(m_asked.in(Volts));
  }

  private void push(double volts) {
    m_motor.setVoltage(volts);
  }

  private void write(SysIdRoutineLog log) {
    MotorLog one = log.motor("chain");
    one.voltage(m_asked);
    one.angularPosition(m_motor.getPosition().getValue()).angularVelocity(speed());
  }

  private edu.wpi.first.units.measure.AngularVelocity speed() {
    return RadiansPerSecond.of(2 * Math.PI * m_motor.getVelocity().getValueAsDouble());
  }
}
