// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/Unit.java

package edu.wpi.first.units;

public abstract class Unit {
  public native String name();

  public native String symbol();
}
