// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/DistanceUnit.java

package edu.wpi.first.units;

import edu.wpi.first.units.measure.Distance;
import edu.wpi.first.units.measure.MutDistance;

public final class DistanceUnit extends Unit {
  public native Distance of(double magnitude);

  public native Distance zero();

  public native Distance one();

  public native MutDistance mutable(double initialMagnitude);

  public native LinearVelocityUnit per(TimeUnit time);
}
