package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

public class Wrapped extends SubsystemBase {
  private final Side m_left = new Side(1);
  private final Side m_right = new Side(2);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(null, null, null, null),
      new SysIdRoutine.Mechanism(
          v -> {
            m_left.setVoltage(v.in(Volts));
            m_right.setVoltage(v.in(Volts));
          },
          log -> log.motor("left").voltage(Volts.of(m_left.volts())),
          this));
}
