// Signatures of allwpilib v2026.2.2: wpilibNewCommands/src/main/java/edu/wpi/first/wpilibj2/command/button/RobotModeTriggers.java

package edu.wpi.first.wpilibj2.command.button;

public final class RobotModeTriggers {
  private RobotModeTriggers() {}

  public static native Trigger autonomous();

  public static native Trigger teleop();

  public static native Trigger disabled();

  public static native Trigger test();
}
