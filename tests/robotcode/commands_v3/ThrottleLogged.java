package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.hardware.motor.PWMSparkMax;
import org.wpilib.hardware.rotation.Encoder;
import org.wpilib.system.RobotController;

/** PWM controllers report no voltage: the throttle times the battery stands for it. */
public class ThrottleLogged extends Mechanism {
  private final PWMSparkMax left = new PWMSparkMax(0);
  private final PWMSparkMax leftBack = new PWMSparkMax(1);
  private final PWMSparkMax right = new PWMSparkMax(2);
  private final Encoder leftEncoder = new Encoder(0, 1);
  private final Encoder rightEncoder = new Encoder(2, 3);

  private final SysIdRoutine routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(Volts.of(1).per(Second), Volts.of(3), Seconds.of(6)),
          new SysIdRoutine.SysIdMechanism(
              volts -> {
                left.setVoltage(volts);
                right.setVoltage(volts);
              },
              log -> {
                log.motor("left")
                    .voltage(Volts.of(left.getThrottle() * RobotController.getBatteryVoltage()))
                    .linearPosition(Meters.of(leftEncoder.getDistance()))
                    .linearVelocity(MetersPerSecond.of(leftEncoder.getRate()));
                log.motor("right")
                    .voltage(Volts.of(right.getThrottle() * RobotController.getBatteryVoltage()))
                    .linearPosition(Meters.of(rightEncoder.getDistance()))
                    .linearVelocity(MetersPerSecond.of(rightEncoder.getRate()));
              },
              this));

  public ThrottleLogged() {
    left.addFollower(leftBack);
  }
}
