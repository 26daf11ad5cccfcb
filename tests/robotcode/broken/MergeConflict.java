import static edu.wpi.first.units.Units.*;

public class MergeConflict extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1);
<<<<<<< HEAD
  private static final double kStep = 3.5;
=======
  private static final double kStep = 7.0;
>>>>>>> practice-bot
}
