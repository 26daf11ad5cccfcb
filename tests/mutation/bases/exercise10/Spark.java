package frc.robot.subsystems;

import com.revrobotics.spark.config.SparkMaxConfig;

/** The student ann's shooter: the encoder of the Spark counts radians. */
public class Spark {
  /** Measured with a fresh battery; measure again when the mechanism changes. */
  public static final class CharacterizationConstants {
    public static final double ROTATION = 2 * Math.PI; // rad
    public static final double kS = 0.08992; // V
    public static final double kV = 0.1645 / ROTATION; // V·s/rad
    public static final double kA = 0.03118 / ROTATION; // V·s²/rad
    public static final double kP = 0.128 / ROTATION / 12; // duty cycle, to start tuning from
  }

  private final SparkMaxConfig m_config = new SparkMaxConfig();

  /** Makes the configuration. */
  public Spark() {
    m_config
        .closedLoop
        .feedForward
        .kS(CharacterizationConstants.kS)
        .kV(CharacterizationConstants.kV)
        .kA(CharacterizationConstants.kA);
  }
}
