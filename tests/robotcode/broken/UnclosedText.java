public class UnclosedText extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1, "canivore);
}
