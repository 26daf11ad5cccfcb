// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/AngularAccelerationUnit.java

package edu.wpi.first.units;

import edu.wpi.first.units.measure.AngularAcceleration;

public final class AngularAccelerationUnit extends Unit {
  public native AngularAcceleration of(double magnitude);

  public native AngularAcceleration zero();

  public native AngularAcceleration one();
}
