package first.robot.mechanisms;

import static org.wpilib.command3.sysid.SysIdRoutine.Config.useDataLog;
import static org.wpilib.units.Units.Second;
import static org.wpilib.units.Units.Seconds;
import static org.wpilib.units.Units.Volts;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.command3.sysid.SysIdRoutine.SysIdMechanism;

/** Names brought in, so that little stands before the dot. */
public class StaticFactory extends Mechanism {
  private final TalonFX m_hood = new TalonFX(9);

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          useDataLog(Volts.of(0.5).per(Second), Volts.of(2.5), Seconds.of(4)),
          new SysIdMechanism(m_hood::setVoltage, null, this));
}
