// Signatures of allwpilib v2026.2.2: wpimath/src/main/java/edu/wpi/first/math/controller/PIDController.java
package edu.wpi.first.math.controller;

public class PIDController {
  public PIDController(double kp, double ki, double kd) {}

  public double calculate(double measurement, double setpoint) {
    return 0.0;
  }
}
