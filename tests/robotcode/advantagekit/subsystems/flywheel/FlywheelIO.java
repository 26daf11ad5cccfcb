package subsystems.flywheel;

import org.littletonrobotics.junction.AutoLog;

/** What the flywheel needs of its hardware, real or simulated. */
public interface FlywheelIO {
  @AutoLog
  public static class FlywheelIOInputs {
    public double positionRad = 0.0;
    public double velocityRadPerSec = 0.0;
    public double appliedVolts = 0.0;
  }

  public default void updateInputs(FlywheelIOInputs inputs) {}

  public default void setVoltage(double volts) {}

  public default void stop() {}
}
