// Signatures of allwpilib v2026.2.2: wpimath/src/main/java/edu/wpi/first/math/controller/ArmFeedforward.java

package edu.wpi.first.math.controller;

public class ArmFeedforward {
  public ArmFeedforward(double ks, double kg, double kv, double ka, double dtSeconds) {}

  public ArmFeedforward(double ks, double kg, double kv, double ka) {}

  public ArmFeedforward(double ks, double kg, double kv) {}

  public native double calculate(double position, double velocity);

  public native double calculateWithVelocities(
      double currentAngle, double currentVelocity, double nextVelocity);
}
