// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/LinearVelocity.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.LinearVelocityUnit;
import edu.wpi.first.units.Measure;
import edu.wpi.first.units.TimeUnit;

public interface LinearVelocity extends Measure<LinearVelocityUnit> {
  LinearVelocity unaryMinus();

  LinearVelocity plus(Measure<? extends LinearVelocityUnit> other);

  LinearVelocity minus(Measure<? extends LinearVelocityUnit> other);

  LinearVelocity times(double multiplier);

  LinearVelocity div(double divisor);

  MutLinearVelocity mutableCopy();

  LinearAcceleration per(TimeUnit period);

  LinearAcceleration div(Time divisor);
}
