// Signatures of allwpilib v2026.2.2: wpilibj/src/main/java/edu/wpi/first/wpilibj/RobotController.java

package edu.wpi.first.wpilibj;

public final class RobotController {
  private RobotController() {}

  public static native double getBatteryVoltage();
}
