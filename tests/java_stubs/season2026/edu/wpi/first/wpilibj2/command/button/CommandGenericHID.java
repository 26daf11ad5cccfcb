// Signatures of allwpilib v2026.2.2: wpilibNewCommands/src/main/java/edu/wpi/first/wpilibj2/command/button/CommandGenericHID.java

package edu.wpi.first.wpilibj2.command.button;

public class CommandGenericHID {
  public CommandGenericHID(int port) {}

  public native Trigger button(int button);
}
