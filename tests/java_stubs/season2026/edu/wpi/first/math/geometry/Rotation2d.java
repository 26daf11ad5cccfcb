// Signatures of allwpilib v2026.2.2: wpimath/src/main/java/edu/wpi/first/math/geometry/Rotation2d.java

package edu.wpi.first.math.geometry;

public class Rotation2d {
  public static final Rotation2d kZero = null;

  public native double getRotations();
}
