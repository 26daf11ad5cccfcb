// Signatures of allwpilib v2026.2.2: wpilibNewCommands/src/main/java/edu/wpi/first/wpilibj2/command/CommandScheduler.java

package edu.wpi.first.wpilibj2.command;

import edu.wpi.first.wpilibj.event.EventLoop;

public final class CommandScheduler {
  private CommandScheduler() {}

  public static native CommandScheduler getInstance();

  public native EventLoop getDefaultButtonLoop();

  public native EventLoop getActiveButtonLoop();

  public native void disable();

  public native void enable();

  public native void cancelAll();
}
