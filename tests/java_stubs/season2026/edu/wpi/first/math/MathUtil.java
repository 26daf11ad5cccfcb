// Signatures of allwpilib v2026.2.2: wpimath/src/main/java/edu/wpi/first/math/MathUtil.java

package edu.wpi.first.math;

public final class MathUtil {
  private MathUtil() {}

  public static native double clamp(double value, double low, double high);
}
