package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.command3.sysid.SysIdRoutine.Config;
import org.wpilib.command3.sysid.SysIdRoutine.SysIdMechanism;
import org.wpilib.units.VoltageUnit;
import org.wpilib.units.measure.Time;
import org.wpilib.units.measure.Velocity;
import org.wpilib.units.measure.Voltage;

/** Config and mechanism in fields of their own, the numbers in a class of constants. */
public class HeldInFields extends Mechanism {
  private static final class Test {
    static final Velocity<VoltageUnit> RAMP = Volts.of(0.5).per(Second);
    static final Voltage STEP = Volts.of(3.5);
    static final Time TIMEOUT = Seconds.of(10);
  }

  private final TalonFX m_turret = new TalonFX(14);
  private final Config m_config = Config.useDataLog(Test.RAMP, Test.STEP, Test.TIMEOUT);
  private final SysIdMechanism m_tested =
      new SysIdMechanism(
          volts -> m_turret.setVoltage(volts.in(Volts)),
          log ->
              log.motor("turret")
                  .voltage(m_turret.getMotorVoltage().getValue())
                  .angularPosition(m_turret.getPosition().getValue())
                  .angularVelocity(m_turret.getVelocity().getValue()),
          this);
  private final SysIdRoutine m_routine = new SysIdRoutine(m_config, m_tested);
}
