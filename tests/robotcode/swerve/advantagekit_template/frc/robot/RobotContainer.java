package frc.robot;

import frc.robot.generated.TunerConstants;
import frc.robot.subsystems.drive.Drive;
import frc.robot.subsystems.drive.ModuleIOTalonFX;

/** Makes the drive as AdvantageKit's template does on the robot itself. */
public class RobotContainer {
  private final Drive drive =
      new Drive(
          new ModuleIOTalonFX(TunerConstants.FrontLeft),
          new ModuleIOTalonFX(TunerConstants.FrontRight),
          new ModuleIOTalonFX(TunerConstants.BackLeft),
          new ModuleIOTalonFX(TunerConstants.BackRight));
}
