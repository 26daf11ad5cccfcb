// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/AngleUnit.java

package edu.wpi.first.units;

import edu.wpi.first.units.measure.Angle;
import edu.wpi.first.units.measure.MutAngle;

public final class AngleUnit extends Unit {
  public native Angle of(double magnitude);

  public native Angle zero();

  public native Angle one();

  public native MutAngle mutable(double initialMagnitude);

  public native AngularVelocityUnit per(TimeUnit time);
}
