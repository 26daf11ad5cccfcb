// Signatures of allwpilib v2026.2.2: wpimath/src/main/java/edu/wpi/first/math/controller/ProfiledPIDController.java
package edu.wpi.first.math.controller;

import edu.wpi.first.math.trajectory.TrapezoidProfile;

public class ProfiledPIDController {
  public ProfiledPIDController(
      double Kp, double Ki, double Kd, TrapezoidProfile.Constraints constraints) {}

  public TrapezoidProfile.State getSetpoint() {
    return null;
  }

  public double calculate(double measurement, double goal) {
    return 0.0;
  }
}
