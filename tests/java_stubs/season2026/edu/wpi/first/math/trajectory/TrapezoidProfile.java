// Signatures of allwpilib v2026.2.2: wpimath/src/main/java/edu/wpi/first/math/trajectory/TrapezoidProfile.java
package edu.wpi.first.math.trajectory;

public class TrapezoidProfile {
  public static class Constraints {
    public Constraints(double maxVelocity, double maxAcceleration) {}
  }

  public static class State {
    public double position;
    public double velocity;
  }
}
