package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import com.ctre.phoenix6.controls.VelocityVoltage;
import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;

/** A mistake: the motor controller holds a speed and chooses the voltage itself. */
public class BySpeed extends Mechanism {
  private final TalonFX m_belt = new TalonFX(23);
  private final VelocityVoltage m_speed = new VelocityVoltage(0);

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.SysIdMechanism(
              volts -> m_belt.setControl(m_speed.withVelocity(volts.in(Volts))), null, this));
}
