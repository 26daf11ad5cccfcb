import static edu.wpi.first.units.Units.*;

public class MissingSemicolon extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1)
  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(
          voltage -> { m_motor.setVoltage(voltage.in(Volts)); },
          log -> { log.motor("m").voltage(m_motor.getMotorVoltage().getValue()); },
          this));
}
