// Signatures of allwpilib v2026.2.2: wpilibNewCommands/src/main/java/edu/wpi/first/wpilibj2/command/button/Trigger.java

package edu.wpi.first.wpilibj2.command.button;

import edu.wpi.first.wpilibj2.command.Command;
import java.util.function.BooleanSupplier;

public class Trigger implements BooleanSupplier {
  public Trigger(BooleanSupplier condition) {}

  public native Trigger onTrue(Command command);

  public native Trigger whileTrue(Command command);

  public native Trigger toggleOnTrue(Command command);

  public native Trigger onFalse(Command command);

  public native Trigger whileFalse(Command command);

  public native Trigger debounce(double seconds);

  public native boolean getAsBoolean();

  public native Trigger and(BooleanSupplier trigger);

  public native Trigger or(BooleanSupplier trigger);

  public native Trigger negate();
}
