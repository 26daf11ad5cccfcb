package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import java.util.List;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;

/** Drive motors in a list: one loop drives them, another writes them down. */
public class ModuleLoop extends Mechanism {
  private final TalonFX m_front = new TalonFX(1);
  private final TalonFX m_back = new TalonFX(2);
  private final List<TalonFX> m_wheels = List.of(m_front, m_back);

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(Volts.of(0.5).per(Second), Volts.of(2), Seconds.of(8)),
          new SysIdRoutine.SysIdMechanism(
              volts -> {
                for (TalonFX wheel : m_wheels) {
                  wheel.setVoltage(volts.in(Volts));
                }
              },
              log ->
                  log.motor("front")
                      .voltage(m_front.getMotorVoltage().getValue())
                      .angularPosition(m_front.getPosition().getValue())
                      .angularVelocity(m_front.getVelocity().getValue()),
              this));
}
