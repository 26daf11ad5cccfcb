package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.math.MathUtil;
import edu.wpi.first.wpilibj.motorcontrol.PWMSparkMax;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Limits around the voltage leave it a voltage, and leave it as it is in between. */
public class Guarded extends SubsystemBase {
  private static final double kMost = 8;
  private final PWMSparkMax m_climber = new PWMSparkMax(3);
  private boolean m_atTop;

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), null),
      new SysIdRoutine.Mechanism(
          volts -> {
            double wanted = MathUtil.clamp(volts.in(Volts), -kMost, kMost);
            if (m_atTop && wanted > 0) {
              m_climber.setVoltage(0);
            } else {
              m_climber.setVoltage(wanted);
            }
          },
          null,
          this));
}
