// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/TimeUnit.java

package edu.wpi.first.units;

import edu.wpi.first.units.measure.Time;

public final class TimeUnit extends Unit {
  public native Time of(double magnitude);

  public native Time zero();

  public native Time one();
}
