// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): commandsv3/src/main/java/org/wpilib/command3/button/RobotModeTriggers.java

package org.wpilib.command3.button;

import org.wpilib.command3.Trigger;

public final class RobotModeTriggers {
  private RobotModeTriggers() {}

  public static native Trigger autonomous();

  public static native Trigger teleop();

  public static native Trigger disabled();

  public static native Trigger utility();
}
