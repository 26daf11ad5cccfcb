// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/CurrentUnit.java

package edu.wpi.first.units;

import edu.wpi.first.units.measure.Current;

public final class CurrentUnit extends Unit {
  public native Current of(double magnitude);

  public native Current zero();

  public native Current one();
}
