import static edu.wpi.first.units.Units.*;

public class CannotBeTold extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1);
  private final boolean m_isPractice = Files.exists(Path.of("practice"));
  static double kStep = 3;

  static {
    kStep = 4; // the second value of kStep
  }

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(
          m_isPractice ? Volts.of(0.5).per(Second) : Volts.of(1).per(Second),
          Volts.of(kStep),
          Seconds.of(Preferences.getDouble("timeout", 10))),
      new SysIdRoutine.Mechanism(
          v -> runAtVoltage(v.in(Volts)),
          log -> writeLog(log),
          m_other));
}
