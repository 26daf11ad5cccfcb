package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.hardware.motor.PWMSparkMax;

/** A mistake: a throttle is a share of the battery, and no voltage. */
public class Throttle extends Mechanism {
  private final PWMSparkMax m_roller = new PWMSparkMax(4);

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.SysIdMechanism(
              volts -> m_roller.setThrottle(volts.in(Volts) / 12.0), null, this));
}
