// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): wpilibj/src/main/java/org/wpilib/system/RobotController.java

package org.wpilib.system;

public final class RobotController {
  private RobotController() {}

  public static native double getBatteryVoltage();
}
