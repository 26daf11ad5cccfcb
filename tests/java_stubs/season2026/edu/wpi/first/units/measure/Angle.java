// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/Angle.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.AngleUnit;
import edu.wpi.first.units.Measure;
import edu.wpi.first.units.TimeUnit;

public interface Angle extends Measure<AngleUnit> {
  Angle unaryMinus();

  Angle plus(Measure<? extends AngleUnit> other);

  Angle minus(Measure<? extends AngleUnit> other);

  Angle times(double multiplier);

  Angle div(double divisor);

  MutAngle mutableCopy();

  AngularVelocity per(TimeUnit period);

  AngularVelocity div(Time divisor);
}
