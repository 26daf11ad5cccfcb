// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/Time.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.Measure;
import edu.wpi.first.units.TimeUnit;

public interface Time extends Measure<TimeUnit> {
  Time unaryMinus();

  Time plus(Measure<? extends TimeUnit> other);

  Time minus(Measure<? extends TimeUnit> other);

  Time times(double multiplier);

  Time div(double divisor);

  double in(TimeUnit unit);
}
