// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/MutAngle.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.AngleUnit;
import edu.wpi.first.units.mutable.MutableMeasureBase;

public abstract class MutAngle extends MutableMeasureBase<AngleUnit, Angle, MutAngle>
    implements Angle {}
