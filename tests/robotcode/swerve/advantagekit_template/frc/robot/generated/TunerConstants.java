package frc.robot.generated;

import com.ctre.phoenix6.swerve.SwerveModuleConstants.ClosedLoopOutputType;
import com.ctre.phoenix6.swerve.SwerveModuleConstantsFactory;

/** As Tuner X generates it, as far as the drive motors go. */
public class TunerConstants {
  private static final ClosedLoopOutputType kSteerClosedLoopOutput = ClosedLoopOutputType.Voltage;
  private static final ClosedLoopOutputType kDriveClosedLoopOutput = ClosedLoopOutputType.Voltage;

  private static final SwerveModuleConstantsFactory<?, ?, ?> ConstantCreator =
      new SwerveModuleConstantsFactory<Object, Object, Object>()
          .withSteerMotorClosedLoopOutput(kSteerClosedLoopOutput)
          .withDriveMotorClosedLoopOutput(kDriveClosedLoopOutput);
}
