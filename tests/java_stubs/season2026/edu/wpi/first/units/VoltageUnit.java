// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/VoltageUnit.java

package edu.wpi.first.units;

import edu.wpi.first.units.measure.MutVoltage;
import edu.wpi.first.units.measure.Voltage;

public final class VoltageUnit extends Unit {
  public native Voltage of(double magnitude);

  public native Voltage zero();

  public native Voltage one();

  public native MutVoltage mutable(double initialMagnitude);

  public native VelocityUnit<VoltageUnit> per(TimeUnit time);
}
