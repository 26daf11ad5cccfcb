public class NoRoutine extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1);

  public void run(double volts) {
    m_motor.setVoltage(volts);
  }
}
