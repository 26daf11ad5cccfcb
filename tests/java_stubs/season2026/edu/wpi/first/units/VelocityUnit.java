// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/VelocityUnit.java

package edu.wpi.first.units;

import edu.wpi.first.units.measure.Velocity;

public final class VelocityUnit<D extends Unit> extends Unit {
  public native Velocity<D> of(double magnitude);
}
