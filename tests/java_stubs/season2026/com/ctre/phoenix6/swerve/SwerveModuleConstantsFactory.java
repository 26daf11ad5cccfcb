// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/swerve/SwerveModuleConstantsFactory.html

package com.ctre.phoenix6.swerve;

import com.ctre.phoenix6.swerve.SwerveModuleConstants.ClosedLoopOutputType;

public class SwerveModuleConstantsFactory<DriveMotorConfigsT, SteerMotorConfigsT, EncoderConfigsT> {
  public native SwerveModuleConstantsFactory<DriveMotorConfigsT, SteerMotorConfigsT, EncoderConfigsT>
      withSteerMotorClosedLoopOutput(ClosedLoopOutputType newSteerMotorClosedLoopOutput);

  public native SwerveModuleConstantsFactory<DriveMotorConfigsT, SteerMotorConfigsT, EncoderConfigsT>
      withDriveMotorClosedLoopOutput(ClosedLoopOutputType newDriveMotorClosedLoopOutput);
}
