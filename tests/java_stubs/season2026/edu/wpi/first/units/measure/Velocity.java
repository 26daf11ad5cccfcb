// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/Velocity.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.Measure;
import edu.wpi.first.units.Unit;
import edu.wpi.first.units.VelocityUnit;

public interface Velocity<D extends Unit> extends Measure<VelocityUnit<D>> {
  Velocity<D> unaryMinus();

  Velocity<D> times(double multiplier);

  Velocity<D> div(double divisor);
}
