// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/mutable/MutableMeasureBase.java

package edu.wpi.first.units.mutable;

import edu.wpi.first.units.Measure;
import edu.wpi.first.units.MutableMeasure;
import edu.wpi.first.units.Unit;

public abstract class MutableMeasureBase<
        U extends Unit, Base extends Measure<U>, MutSelf extends MutableMeasure<U, Base, MutSelf>>
    implements Measure<U>, MutableMeasure<U, Base, MutSelf> {}
