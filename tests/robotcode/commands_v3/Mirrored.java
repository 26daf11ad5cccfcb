package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;

/** The second motor stands the other way round, and gets the voltage with another sign. */
public class Mirrored extends Mechanism {
  private final TalonFX m_upper = new TalonFX(51);
  private final TalonFX m_lower = new TalonFX(52);

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(
              Volts.of(1).div(Seconds.of(2)), Volts.of(3).plus(Volts.of(0.5)), Seconds.of(10)),
          new SysIdRoutine.SysIdMechanism(
              volts -> {
                m_upper.setVoltage(volts.in(Volts));
                m_lower.setVoltage(-volts.in(Volts));
              },
              null,
              this));
}
