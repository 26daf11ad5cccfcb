import static edu.wpi.first.units.Units.*;

public class SmartQuotes extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1, “canivore”);
}
