// Signatures of allwpilib v2026.2.2: wpilibNewCommands/src/main/java/edu/wpi/first/wpilibj2/command/Command.java

package edu.wpi.first.wpilibj2.command;

import edu.wpi.first.units.measure.Time;
import java.util.function.BooleanSupplier;

public abstract class Command {
  public native Command withTimeout(double seconds);

  public native Command withTimeout(Time time);

  public native Command andThen(Command... next);

  public native Command withName(String name);

  public native Command until(BooleanSupplier condition);

  public native Command unless(BooleanSupplier condition);

  public native Command onlyIf(BooleanSupplier condition);

  public native Command onlyWhile(BooleanSupplier condition);

  public native Command raceWith(Command... parallel);
}
