package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;

/** A mistake: the routine is given another mechanism, so its tests do not lock this one. */
public class OtherOwner extends Mechanism {
  private final Mechanism m_lights = new Mechanism("lights");
  private final TalonFX m_feeder = new TalonFX(41);

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.SysIdMechanism(
              volts -> m_feeder.setVoltage(volts.in(Volts)), null, m_lights));
}
