package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.math.util.Units;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.motorcontrol.MotorController;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import java.util.Map;
import java.util.Optional;

/** Optional motors, a map of motors, a voltage in millivolts, a motor behind its interface. */
public class UnitsAgain extends SubsystemBase {
  private final MotorController m_plain;
  private final Optional<TalonFX> m_maybe = Optional.empty();
  private final TalonFX m_back = new TalonFX(3);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Millivolts.of(3.5), Seconds.of(600_000 / 60_000)),
      new SysIdRoutine.Mechanism(
          (Voltage v) -> {
            final double millivolts = v.in(Millivolts);
            m_plain.setVoltage(millivolts);
            m_back.setVoltage(millivolts / 1000);
          },
          log ->
              log.motor("back")
                  .voltage(Millivolts.of(m_back.getMotorVoltage().getValueAsDouble()))
                  .angularPosition(Radians.of(Units.rotationsToRadians(m_back.getPosition().getValueAsDouble())))
                  .angularVelocity(RadiansPerSecond.of(0)),
          this));

  public UnitsAgain(MotorController motor) {
    m_plain = motor;
  }
}
