// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/AngularVelocityUnit.java

package edu.wpi.first.units;

import edu.wpi.first.units.measure.AngularVelocity;
import edu.wpi.first.units.measure.MutAngularVelocity;

public final class AngularVelocityUnit extends Unit {
  public native AngularVelocity of(double magnitude);

  public native AngularVelocity zero();

  public native AngularVelocity one();

  public native MutAngularVelocity mutable(double initialMagnitude);

  public native AngularAccelerationUnit per(TimeUnit time);
}
