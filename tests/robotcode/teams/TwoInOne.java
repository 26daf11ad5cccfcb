package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Declared together, made in the constructor; a setter that takes the motor. */
public class TwoInOne extends SubsystemBase {
  private TalonFX m_left, m_right;
  private SysIdRoutine m_routine;

  public TwoInOne() {
    this.m_left = new TalonFX(1);
    this.m_right = new TalonFX(2);
    this.m_routine = new SysIdRoutine(getConfig(), getMechanism());
  }

  private SysIdRoutine.Config getConfig() {
    return new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10));
  }

  private SysIdRoutine.Mechanism getMechanism() {
    return new SysIdRoutine.Mechanism(this::both, null, this);
  }

  private void both(Voltage volts) {
    send(m_left, volts);
    send(m_right, volts);
  }

  private static void send(TalonFX motor, Voltage volts) {
    motor.setControl(new VoltageOut(volts.in(Volts)).withEnableFOC(false));
  }
}
