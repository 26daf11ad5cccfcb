// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/Distance.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.DistanceUnit;
import edu.wpi.first.units.Measure;
import edu.wpi.first.units.TimeUnit;

public interface Distance extends Measure<DistanceUnit> {
  Distance unaryMinus();

  Distance plus(Measure<? extends DistanceUnit> other);

  Distance minus(Measure<? extends DistanceUnit> other);

  Distance times(double multiplier);

  Distance div(double divisor);

  MutDistance mutableCopy();

  LinearVelocity per(TimeUnit period);

  LinearVelocity div(Time divisor);
}
