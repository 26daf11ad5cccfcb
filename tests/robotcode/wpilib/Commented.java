package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;

/**
 * Used to have one:
 * <pre>new SysIdRoutine(new SysIdRoutine.Config(), new SysIdRoutine.Mechanism(a, b, this))</pre>
 */
public class Commented extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1);
  /*
  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(1).per(Second), Volts.of(7), Seconds.of(10)),
      new SysIdRoutine.Mechanism(v -> m_motor.setVoltage(v.in(Volts)), null, this));
  */
  // private final SysIdRoutine m_other = new SysIdRoutine(new SysIdRoutine.Config(), null);
  private final String m_hint = "new SysIdRoutine(new SysIdRoutine.Config(), null)";
}
