// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/LinearAcceleration.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.LinearAccelerationUnit;
import edu.wpi.first.units.Measure;

public interface LinearAcceleration extends Measure<LinearAccelerationUnit> {
  LinearAcceleration unaryMinus();

  LinearAcceleration plus(Measure<? extends LinearAccelerationUnit> other);

  LinearAcceleration minus(Measure<? extends LinearAccelerationUnit> other);

  LinearAcceleration times(double multiplier);

  LinearAcceleration div(double divisor);
}
