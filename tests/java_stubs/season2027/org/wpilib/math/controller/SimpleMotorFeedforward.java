// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): wpimath/src/main/java/org/wpilib/math/controller/SimpleMotorFeedforward.java

package org.wpilib.math.controller;

public class SimpleMotorFeedforward {
  public SimpleMotorFeedforward(double ks, double kv, double ka, double dt) {}

  public SimpleMotorFeedforward(double ks, double kv, double ka) {}

  public SimpleMotorFeedforward(double ks, double kv) {}

  public native double calculate(double velocity);

  public native double calculate(double currentVelocity, double nextVelocity);
}
