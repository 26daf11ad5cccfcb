// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/AngularVelocity.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.AngularVelocityUnit;
import edu.wpi.first.units.Measure;
import edu.wpi.first.units.TimeUnit;

public interface AngularVelocity extends Measure<AngularVelocityUnit> {
  AngularVelocity unaryMinus();

  AngularVelocity plus(Measure<? extends AngularVelocityUnit> other);

  AngularVelocity minus(Measure<? extends AngularVelocityUnit> other);

  AngularVelocity times(double multiplier);

  AngularVelocity div(double divisor);

  MutAngularVelocity mutableCopy();

  AngularAcceleration per(TimeUnit period);

  AngularAcceleration div(Time divisor);
}
