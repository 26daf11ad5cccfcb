package frc.robot.subsystems.drive;

import edu.wpi.first.math.geometry.Rotation2d;

/** What a module's hardware can do. */
public interface ModuleIO {
  default void setDriveOpenLoop(double output) {}

  default void setTurnPosition(Rotation2d rotation) {}
}
