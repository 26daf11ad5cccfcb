package first.robot.mechanisms;

import static org.wpilib.units.Units.Volts;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;

/** WPILib's own numbers, and a log that the vendor writes. */
public class Defaults extends Mechanism {
  private final TalonFX lift = new TalonFX(11);

  private final SysIdRoutine sysId =
      new SysIdRoutine(
          SysIdRoutine.Config.defaults(),
          new SysIdRoutine.SysIdMechanism(
              volts -> lift.setVoltage(volts.in(Volts)), null, this));
}
