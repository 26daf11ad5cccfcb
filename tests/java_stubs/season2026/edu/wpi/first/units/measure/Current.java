// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/Current.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.CurrentUnit;
import edu.wpi.first.units.Measure;

public interface Current extends Measure<CurrentUnit> {
  Current unaryMinus();

  Current plus(Measure<? extends CurrentUnit> other);

  Current minus(Measure<? extends CurrentUnit> other);

  Current times(double multiplier);

  Current div(double divisor);
}
