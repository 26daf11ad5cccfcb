// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): commandsv3/src/generated/main/java/org/wpilib/command3/button/CommandXboxController.java

package org.wpilib.command3.button;

import org.wpilib.command3.Trigger;

public class CommandXboxController {
  public CommandXboxController(int port) {}

  public native Trigger a();

  public native Trigger b();

  public native Trigger x();

  public native Trigger y();

  public native double getLeftY();
}
