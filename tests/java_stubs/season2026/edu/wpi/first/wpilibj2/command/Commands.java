// Signatures of allwpilib v2026.2.2: wpilibNewCommands/src/main/java/edu/wpi/first/wpilibj2/command/Commands.java

package edu.wpi.first.wpilibj2.command;

public final class Commands {
  private Commands() {}

  public static native Command none();

  public static native Command waitSeconds(double seconds);
}
