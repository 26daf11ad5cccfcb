// Signatures of allwpilib v2026.2.2: wpilibNewCommands/src/main/java/edu/wpi/first/wpilibj2/command/SubsystemBase.java

package edu.wpi.first.wpilibj2.command;

public abstract class SubsystemBase implements Subsystem {
  public native String getName();

  public native void setName(String name);
}
