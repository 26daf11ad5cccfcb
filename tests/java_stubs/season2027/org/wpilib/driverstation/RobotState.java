// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): wpilibj/src/main/java/org/wpilib/driverstation/RobotState.java

package org.wpilib.driverstation;

public final class RobotState {
  private RobotState() {}

  public static native boolean isEnabled();

  public static native boolean isUtility();

  public static native boolean isUtilityEnabled();
}
