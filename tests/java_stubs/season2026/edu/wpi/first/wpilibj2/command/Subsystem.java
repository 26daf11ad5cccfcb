// Signatures of allwpilib v2026.2.2: wpilibNewCommands/src/main/java/edu/wpi/first/wpilibj2/command/Subsystem.java

package edu.wpi.first.wpilibj2.command;

public interface Subsystem {
  default void periodic() {}

  default String getName() {
    return null;
  }

  default void setDefaultCommand(Command defaultCommand) {}

  default Command runOnce(Runnable action) {
    return null;
  }

  default Command run(Runnable action) {
    return null;
  }
}
