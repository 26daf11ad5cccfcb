// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): commandsv2/src/generated/main/java/org/wpilib/command2/button/CommandXboxController.java

package org.wpilib.command2.button;

public class CommandXboxController {
  public CommandXboxController(int port) {}

  public native Trigger a();

  public native Trigger b();

  public native Trigger x();

  public native Trigger y();

  public native double getLeftY();
}
