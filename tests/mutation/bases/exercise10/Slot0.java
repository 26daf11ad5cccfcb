package frc.robot.subsystems;

import com.ctre.phoenix6.configs.Slot0Configs;
import com.ctre.phoenix6.configs.TalonFXConfiguration;
import com.ctre.phoenix6.signals.StaticFeedforwardSignValue;

/** The student ann's shooter: Phoenix 6 counts rotations, as the analyzer did. */
public class Slot0 {
  /** Measured with a fresh battery; measure again when the mechanism changes. */
  public static final class CharacterizationConstants {
    public static final double kS = 0.08992; // V
    public static final double kV = 0.1645; // V·s/rot of the wheel
    public static final double kA = 0.03118; // V·s²/rot of the wheel
    public static final double kP = 0.128; // the analyzer's suggestion: start here
  }

  private final TalonFXConfiguration m_config = new TalonFXConfiguration();

  /** Makes the configuration. */
  public Slot0() {
    m_config.Slot0 =
        new Slot0Configs()
            .withKS(CharacterizationConstants.kS)
            .withKV(CharacterizationConstants.kV)
            .withKA(CharacterizationConstants.kA)
            .withKP(CharacterizationConstants.kP)
            .withStaticFeedforwardSign(StaticFeedforwardSignValue.UseVelocitySign);
  }
}
