// Signatures of allwpilib v2026.2.2: wpimath/src/main/java/edu/wpi/first/math/controller/SimpleMotorFeedforward.java

package edu.wpi.first.math.controller;

public class SimpleMotorFeedforward {
  public SimpleMotorFeedforward(double ks, double kv, double ka, double dtSeconds) {}

  public SimpleMotorFeedforward(double ks, double kv, double ka) {}

  public SimpleMotorFeedforward(double ks, double kv) {}

  public native double calculate(double velocity);

  public native double calculateWithVelocities(double currentVelocity, double nextVelocity);
}
