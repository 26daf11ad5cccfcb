package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Position along a line, velocity around an axis. */
public class MixedFamilies extends SubsystemBase {
  private final TalonFX m_drum = new TalonFX(6);
  private double m_lastVolts = 0;

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(30).per(Minute), Volts.of(7).div(2), Seconds.of(10)),
      new SysIdRoutine.Mechanism(
          volts -> {
            m_lastVolts = volts.in(Volts);
            m_drum.setVoltage(m_lastVolts);
          },
          log -> log.motor("drum")
              .voltage(Volts.of(m_lastVolts))
              .linearPosition(Inches.of(m_drum.getPosition().getValueAsDouble() * 4))
              .angularVelocity(RotationsPerSecond.of(m_drum.getVelocity().getValueAsDouble()))
              .current(Amps.of(m_drum.getStatorCurrent().getValueAsDouble())),
          this));
}
