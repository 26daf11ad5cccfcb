package first.robot.mechanisms;

import static org.wpilib.units.Units.Second;
import static org.wpilib.units.Units.Seconds;
import static org.wpilib.units.Units.Volts;

import com.ctre.phoenix6.BaseStatusSignal;
import com.ctre.phoenix6.StatusSignal;
import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.units.measure.Angle;
import org.wpilib.units.measure.AngularVelocity;
import org.wpilib.units.measure.Voltage;

/** Signals kept in fields and refreshed together. */
public class SignalsRefreshed extends Mechanism {
  private final TalonFX wheel = new TalonFX(21);
  private final StatusSignal<Voltage> voltage = wheel.getMotorVoltage();
  private final StatusSignal<Angle> position = wheel.getPosition();
  private final StatusSignal<AngularVelocity> velocity = wheel.getVelocity();

  private final SysIdRoutine routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(Volts.of(0.25).per(Second), Volts.of(6), Seconds.of(20)),
          new SysIdRoutine.SysIdMechanism(
              volts -> wheel.setVoltage(volts.in(Volts)),
              log -> {
                BaseStatusSignal.refreshAll(voltage, position, velocity);
                log.motor("flywheel")
                    .voltage(voltage.getValue())
                    .angularPosition(position.getValue())
                    .angularVelocity(velocity.getValue());
              },
              this));
}
