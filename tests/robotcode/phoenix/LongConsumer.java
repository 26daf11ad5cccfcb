package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import java.util.function.Consumer;

/** Written as Java was before it had lambdas. */
public class LongConsumer extends SubsystemBase {
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
          new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.Mechanism(
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
