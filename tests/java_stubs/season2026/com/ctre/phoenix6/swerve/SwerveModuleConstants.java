// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/swerve/SwerveModuleConstants.html

package com.ctre.phoenix6.swerve;

public class SwerveModuleConstants<DriveMotorConfigsT, SteerMotorConfigsT, EncoderConfigsT> {
  public enum ClosedLoopOutputType {
    Voltage,
    TorqueCurrentFOC
  }

  public int SteerMotorId;
  public int DriveMotorId;
  public ClosedLoopOutputType SteerMotorClosedLoopOutput;
  public ClosedLoopOutputType DriveMotorClosedLoopOutput;
}
