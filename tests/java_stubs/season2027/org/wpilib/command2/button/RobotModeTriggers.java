// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): commandsv2/src/main/java/org/wpilib/command2/button/RobotModeTriggers.java

package org.wpilib.command2.button;

public final class RobotModeTriggers {
  private RobotModeTriggers() {}

  public static native Trigger autonomous();

  public static native Trigger teleop();

  public static native Trigger disabled();

  public static native Trigger utility();
}
