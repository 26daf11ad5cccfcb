package frc.robot.subsystems.drive;

import edu.wpi.first.math.geometry.Rotation2d;

/** What a module's hardware can do; a replay uses it as it is and does nothing. */
public interface ModuleIO {
  public static class ModuleIOInputs {
    public double drivePositionRad = 0.0;
    public double driveVelocityRadPerSec = 0.0;
    public double driveAppliedVolts = 0.0;
  }

  public default void updateInputs(ModuleIOInputs inputs) {}

  public default void setDriveOpenLoop(double output) {}

  public default void setTurnOpenLoop(double output) {}

  public default void setDriveVelocity(double velocityRadPerSec) {}

  public default void setTurnPosition(Rotation2d rotation) {}
}
