// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/AngularAcceleration.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.AngularAccelerationUnit;
import edu.wpi.first.units.Measure;

public interface AngularAcceleration extends Measure<AngularAccelerationUnit> {
  AngularAcceleration unaryMinus();

  AngularAcceleration plus(Measure<? extends AngularAccelerationUnit> other);

  AngularAcceleration minus(Measure<? extends AngularAccelerationUnit> other);

  AngularAcceleration times(double multiplier);

  AngularAcceleration div(double divisor);
}
