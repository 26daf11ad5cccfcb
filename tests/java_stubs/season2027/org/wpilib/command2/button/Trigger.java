// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): commandsv2/src/main/java/org/wpilib/command2/button/Trigger.java

package org.wpilib.command2.button;

import java.util.function.BooleanSupplier;
import org.wpilib.command2.Command;

public class Trigger implements BooleanSupplier {
  public Trigger(BooleanSupplier condition) {}

  public native Trigger onTrue(Command command);

  public native Trigger whileTrue(Command command);

  public native Trigger onFalse(Command command);

  public native Trigger whileFalse(Command command);

  public native boolean getAsBoolean();

  public native Trigger and(BooleanSupplier trigger);

  public native Trigger or(BooleanSupplier trigger);

  public native Trigger negate();
}
