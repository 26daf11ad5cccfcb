// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): commandsv3/src/main/java/org/wpilib/command3/Command.java

package org.wpilib.command3;

import org.wpilib.units.measure.Time;

public interface Command {
  String name();

  Command withTimeout(Time timeout);
}
