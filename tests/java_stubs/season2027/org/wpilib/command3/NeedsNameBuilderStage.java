// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): commandsv3/src/main/java/org/wpilib/command3/NeedsNameBuilderStage.java

package org.wpilib.command3;

import java.util.function.BooleanSupplier;

public interface NeedsNameBuilderStage {
  NeedsNameBuilderStage whenCanceled(Runnable onCancel);

  NeedsNameBuilderStage withPriority(int priority);

  NeedsNameBuilderStage until(BooleanSupplier endCondition);

  Command named(String name);
}
