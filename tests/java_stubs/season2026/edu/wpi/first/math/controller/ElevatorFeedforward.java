// Signatures of allwpilib v2026.2.2: wpimath/src/main/java/edu/wpi/first/math/controller/ElevatorFeedforward.java

package edu.wpi.first.math.controller;

public class ElevatorFeedforward {
  public ElevatorFeedforward(double ks, double kg, double kv, double ka, double dtSeconds) {}

  public ElevatorFeedforward(double ks, double kg, double kv, double ka) {}

  public ElevatorFeedforward(double ks, double kg, double kv) {}

  public native double calculate(double velocity);

  public native double calculateWithVelocities(double currentVelocity, double nextVelocity);
}
