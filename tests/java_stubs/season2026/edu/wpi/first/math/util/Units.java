// Signatures of allwpilib v2026.2.2: wpimath/src/main/java/edu/wpi/first/math/util/Units.java

package edu.wpi.first.math.util;

public final class Units {
  private Units() {}

  public static native double inchesToMeters(double inches);

  public static native double rotationsToRadians(double rotations);
}
