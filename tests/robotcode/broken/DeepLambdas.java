import static edu.wpi.first.units.Units.*;

public class DeepLambdas extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1);
  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(((((((((((((((((((((((((((((((((((((((((0.5))))))))))))))))))))))))))))))))))))))))).per(Second), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(v -> { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) { if (true) m_motor.setVoltage(v.in(Volts)); } } } } } } } } } } } } } } } } } } } }, null, this));
}
