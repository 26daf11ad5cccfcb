// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/LinearAccelerationUnit.java

package edu.wpi.first.units;

import edu.wpi.first.units.measure.LinearAcceleration;

public final class LinearAccelerationUnit extends Unit {
  public native LinearAcceleration of(double magnitude);

  public native LinearAcceleration zero();

  public native LinearAcceleration one();
}
