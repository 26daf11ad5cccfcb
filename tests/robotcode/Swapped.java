import static edu.wpi.first.units.Units.*;

public class Swapped extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1);
  private final SysIdRoutine.Config m_config =
      new SysIdRoutine.Config(Volts.of(0.5), Volts.of(3.5).per(Second), Volts.of(10));

  private final SysIdRoutine m_routine = new SysIdRoutine(mechanism(), m_config);

  private SysIdRoutine.Mechanism mechanism() {
    return new SysIdRoutine.Mechanism(m_motor::setVoltage, null, null);
  }
}
