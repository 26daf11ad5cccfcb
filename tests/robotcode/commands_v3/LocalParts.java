package first.robot.mechanisms;

import static org.wpilib.units.Units.Second;
import static org.wpilib.units.Units.Seconds;
import static org.wpilib.units.Units.Volts;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Command;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;

/** Everything is made in a method, when a test is asked for. */
public class LocalParts extends Mechanism {
  private final TalonFX intake = new TalonFX(17);

  public Command dynamicForward() {
    var config =
        SysIdRoutine.Config.useDataLog(Volts.of(0.5).per(Second), Volts.of(3), Seconds.of(3));
    var mechanism =
        new SysIdRoutine.SysIdMechanism(
            volts -> {
              double output = volts.in(Volts);
              intake.setVoltage(output);
            },
            null,
            this);
    return new SysIdRoutine(config, mechanism).dynamic(SysIdRoutine.Direction.FORWARD);
  }
}
