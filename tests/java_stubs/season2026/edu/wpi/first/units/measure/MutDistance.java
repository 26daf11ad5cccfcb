// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/MutDistance.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.DistanceUnit;
import edu.wpi.first.units.mutable.MutableMeasureBase;

public abstract class MutDistance extends MutableMeasureBase<DistanceUnit, Distance, MutDistance>
    implements Distance {}
