// Signatures of allwpilib v2026.2.2: wpilibj/src/main/java/edu/wpi/first/wpilibj/DriverStation.java

package edu.wpi.first.wpilibj;

public final class DriverStation {
  private DriverStation() {}

  public static native boolean isEnabled();

  public static native boolean isDisabled();

  public static native boolean isTest();

  public static native boolean isTestEnabled();
}
