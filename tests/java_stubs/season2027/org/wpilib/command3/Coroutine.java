// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): commandsv3/src/main/java/org/wpilib/command3/Coroutine.java

package org.wpilib.command3;

import org.wpilib.units.measure.Time;

public final class Coroutine {
  private Coroutine() {}

  public native boolean yield();

  public native void park();

  public native void wait(Time duration);
}
