package first.robot.mechanisms;

import static org.wpilib.units.Units.Second;
import static org.wpilib.units.Units.Volts;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;

/** A mistake: null was a default once; Commands v3 stops with a NullPointerException. */
public class NullTimeout extends Mechanism {
  private final TalonFX wrist = new TalonFX(3);
  private final SysIdRoutine routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(2), null, null),
          new SysIdRoutine.SysIdMechanism(
              volts -> wrist.setVoltage(volts.in(Volts)),
              log ->
                  log.motor("wrist")
                      .voltage(wrist.getMotorVoltage().getValue())
                      .angularPosition(wrist.getPosition().getValue())
                      .angularVelocity(wrist.getVelocity().getValue()),
              this));
}
