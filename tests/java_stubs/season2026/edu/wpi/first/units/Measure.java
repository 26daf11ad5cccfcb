// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/Measure.java

package edu.wpi.first.units;

public interface Measure<U extends Unit> extends Comparable<Measure<U>> {
  double magnitude();

  double baseUnitMagnitude();

  U unit();

  double in(U unit);

  boolean gt(Measure<U> other);

  boolean lt(Measure<U> other);
}
