// Signatures of allwpilib v2026.2.2: wpilibNewCommands/src/generated/main/java/edu/wpi/first/wpilibj2/command/button/CommandXboxController.java

package edu.wpi.first.wpilibj2.command.button;

public class CommandXboxController extends CommandGenericHID {
  public CommandXboxController(int port) {
    super(port);
  }

  public native Trigger a();

  public native Trigger b();

  public native Trigger x();

  public native Trigger y();

  public native Trigger start();

  public native double getLeftY();
}
