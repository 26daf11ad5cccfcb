// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/MutableMeasure.java

package edu.wpi.first.units;

public interface MutableMeasure<
        U extends Unit, Base extends Measure<U>, MutSelf extends MutableMeasure<U, Base, MutSelf>>
    extends Measure<U> {
  MutSelf mut_replace(double magnitude, U newUnit);

  MutSelf mut_replace(Base other);
}
