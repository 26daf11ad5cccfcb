// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): wpimath/src/main/java/org/wpilib/math/controller/ElevatorFeedforward.java

package org.wpilib.math.controller;

public class ElevatorFeedforward {
  public ElevatorFeedforward(double ks, double kg, double kv, double ka, double dt) {}

  public ElevatorFeedforward(double ks, double kg, double kv, double ka) {}

  public ElevatorFeedforward(double ks, double kg, double kv) {}

  public native double calculate(double velocity);

  public native double calculate(double currentVelocity, double nextVelocity);
}
