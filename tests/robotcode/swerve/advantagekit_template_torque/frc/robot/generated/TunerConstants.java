package frc.robot.generated;

import com.ctre.phoenix6.swerve.SwerveModuleConstants;
import com.ctre.phoenix6.swerve.SwerveModuleConstants.ClosedLoopOutputType;
import com.ctre.phoenix6.swerve.SwerveModuleConstantsFactory;

/** As Tuner X generates it, as far as the drive motors go. */
public class TunerConstants {
  private static final ClosedLoopOutputType kSteerClosedLoopOutput = ClosedLoopOutputType.Voltage;
  private static final ClosedLoopOutputType kDriveClosedLoopOutput = ClosedLoopOutputType.TorqueCurrentFOC;

  private static final SwerveModuleConstantsFactory<?, ?, ?> ConstantCreator =
      new SwerveModuleConstantsFactory<Object, Object, Object>()
          .withSteerMotorClosedLoopOutput(kSteerClosedLoopOutput)
          .withDriveMotorClosedLoopOutput(kDriveClosedLoopOutput);

  public static final SwerveModuleConstants<?, ?, ?> FrontLeft =
      ConstantCreator.createModuleConstants(1, 2, 3, 0.0, 0.3, 0.3, false, false, false);
  public static final SwerveModuleConstants<?, ?, ?> FrontRight =
      ConstantCreator.createModuleConstants(4, 5, 6, 0.0, 0.3, 0.3, false, false, false);
  public static final SwerveModuleConstants<?, ?, ?> BackLeft =
      ConstantCreator.createModuleConstants(7, 8, 9, 0.0, 0.3, 0.3, false, false, false);
  public static final SwerveModuleConstants<?, ?, ?> BackRight =
      ConstantCreator.createModuleConstants(10, 11, 12, 0.0, 0.3, 0.3, false, false, false);
}
