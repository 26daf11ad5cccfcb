// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/MutAngularVelocity.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.AngularVelocityUnit;
import edu.wpi.first.units.mutable.MutableMeasureBase;

public abstract class MutAngularVelocity extends MutableMeasureBase<AngularVelocityUnit, AngularVelocity, MutAngularVelocity>
    implements AngularVelocity {}
