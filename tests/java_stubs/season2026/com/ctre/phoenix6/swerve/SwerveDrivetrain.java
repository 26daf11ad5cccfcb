// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/swerve/SwerveDrivetrain.html

package com.ctre.phoenix6.swerve;

public class SwerveDrivetrain {
  public native void setControl(SwerveRequest request);
}
