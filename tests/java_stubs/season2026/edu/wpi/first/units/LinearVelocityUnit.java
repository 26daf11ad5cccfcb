// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/LinearVelocityUnit.java

package edu.wpi.first.units;

import edu.wpi.first.units.measure.LinearVelocity;
import edu.wpi.first.units.measure.MutLinearVelocity;

public final class LinearVelocityUnit extends Unit {
  public native LinearVelocity of(double magnitude);

  public native LinearVelocity zero();

  public native LinearVelocity one();

  public native MutLinearVelocity mutable(double initialMagnitude);

  public native LinearAccelerationUnit per(TimeUnit time);
}
