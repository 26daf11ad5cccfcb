// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/Voltage.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.Measure;
import edu.wpi.first.units.TimeUnit;
import edu.wpi.first.units.VoltageUnit;

public interface Voltage extends Measure<VoltageUnit> {
  Voltage unaryMinus();

  Voltage plus(Measure<? extends VoltageUnit> other);

  Voltage minus(Measure<? extends VoltageUnit> other);

  Voltage times(double multiplier);

  Voltage div(double divisor);

  MutVoltage mutableCopy();

  Velocity<VoltageUnit> per(TimeUnit period);

  Velocity<VoltageUnit> div(Time divisor);
}
