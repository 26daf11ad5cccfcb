// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/MutVoltage.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.VoltageUnit;
import edu.wpi.first.units.mutable.MutableMeasureBase;

public abstract class MutVoltage extends MutableMeasureBase<VoltageUnit, Voltage, MutVoltage>
    implements Voltage {}
