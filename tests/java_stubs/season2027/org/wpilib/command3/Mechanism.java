// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): commandsv3/src/main/java/org/wpilib/command3/Mechanism.java

package org.wpilib.command3;

import java.util.function.Consumer;

public class Mechanism {
  protected Mechanism() {}

  public Mechanism(String name) {}

  public native String getName();

  public native void setDefaultCommand(Command defaultCommand);

  public native NeedsNameBuilderStage run(Consumer<Coroutine> commandBody);

  public native NeedsNameBuilderStage runRepeatedly(Runnable loopBody);

  public native Command idle();
}
