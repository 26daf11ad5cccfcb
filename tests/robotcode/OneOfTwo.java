import static edu.wpi.first.units.Units.*;

public class OneOfTwo extends SubsystemBase {
  private final TalonFX m_left = new TalonFX(1);
  private final TalonFX m_right = new TalonFX(2);
  private final TalonFX m_unused = new TalonFX(3);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(
          v -> {
            m_left.setVoltage(-v.in(Volts));
            m_right.setVoltage(3.0);
          },
          log -> log.motor("left" + "-front").voltage(m_left.getMotorVoltage().getValue()),
          this));
}
