// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): wpimath/src/main/java/org/wpilib/math/controller/ArmFeedforward.java

package org.wpilib.math.controller;

public class ArmFeedforward {
  public ArmFeedforward(double ks, double kg, double kv, double ka, double dt) {}

  public ArmFeedforward(double ks, double kg, double kv, double ka) {}

  public ArmFeedforward(double ks, double kg, double kv) {}

  public native double calculate(double position, double velocity);

  public native double calculate(double currentAngle, double currentVelocity, double nextVelocity);
}
