package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import java.util.function.Consumer;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.sysid.SysIdRoutineLog;
import org.wpilib.units.measure.Voltage;

/** Callbacks written as Java was before it had lambdas. */
public class LongConsumers extends Mechanism {
  private final TalonFX m_lift = new TalonFX(5);

  private final Consumer<Voltage> m_apply =
      new Consumer<Voltage>() {
        @Override
        public void accept(Voltage voltage) {
          m_lift.setVoltage(voltage.in(Volts));
        }
      };

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.SysIdMechanism(
              m_apply,
              new Consumer<SysIdRoutineLog>() {
                @Override
                public void accept(SysIdRoutineLog log) {
                  log.motor("lift")
                      .voltage(m_lift.getMotorVoltage().getValue())
                      .linearPosition(Meters.of(m_lift.getPosition().getValueAsDouble() * 0.05))
                      .linearVelocity(
                          MetersPerSecond.of(m_lift.getVelocity().getValueAsDouble() * 0.05));
                }
              },
              this));
}
