// Signatures of allwpilib v2026.2.2: wpiunits/src/generated/main/java/edu/wpi/first/units/measure/MutLinearVelocity.java

package edu.wpi.first.units.measure;

import edu.wpi.first.units.LinearVelocityUnit;
import edu.wpi.first.units.mutable.MutableMeasureBase;

public abstract class MutLinearVelocity extends MutableMeasureBase<LinearVelocityUnit, LinearVelocity, MutLinearVelocity>
    implements LinearVelocity {}
