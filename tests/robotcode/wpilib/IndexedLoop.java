package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.wpilibj.motorcontrol.Talon;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Motors in an array, by index. */
public class IndexedLoop extends SubsystemBase {
  private final Talon m_front = new Talon(0);
  private final Talon m_back = new Talon(1);
  private final Talon[] m_wheels = {m_front, m_back};

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(1 / 2).per(Second), Volts.of(7 / 2), Seconds.of(21 / 2)),
      new SysIdRoutine.Mechanism(
          volts -> {
            for (int i = 0; i < m_wheels.length; i++) {
              m_wheels[i].setVoltage(volts.in(Volts));
            }
          },
          null,
          this));
}
