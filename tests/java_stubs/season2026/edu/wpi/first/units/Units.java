// Signatures of allwpilib v2026.2.2: wpiunits/src/main/java/edu/wpi/first/units/Units.java

package edu.wpi.first.units;

public final class Units {
  private Units() {}

  public static final DistanceUnit Meters = null;
  public static final DistanceUnit Meter = null;
  public static final DistanceUnit Millimeters = null;
  public static final DistanceUnit Millimeter = null;
  public static final DistanceUnit Centimeters = null;
  public static final DistanceUnit Centimeter = null;
  public static final DistanceUnit Inches = null;
  public static final DistanceUnit Inch = null;
  public static final DistanceUnit Feet = null;
  public static final DistanceUnit Foot = null;
  public static final TimeUnit Seconds = null;
  public static final TimeUnit Second = null;
  public static final TimeUnit Milliseconds = null;
  public static final TimeUnit Millisecond = null;
  public static final TimeUnit Microseconds = null;
  public static final TimeUnit Microsecond = null;
  public static final TimeUnit Minutes = null;
  public static final TimeUnit Minute = null;
  public static final AngleUnit Radians = null;
  public static final AngleUnit Radian = null;
  public static final AngleUnit Revolutions = null;
  public static final AngleUnit Revolution = null;
  public static final AngleUnit Rotations = null;
  public static final AngleUnit Rotation = null;
  public static final AngleUnit Degrees = null;
  public static final AngleUnit Degree = null;
  public static final LinearVelocityUnit MetersPerSecond = null;
  public static final LinearVelocityUnit FeetPerSecond = null;
  public static final LinearVelocityUnit InchesPerSecond = null;
  public static final AngularVelocityUnit RevolutionsPerSecond = null;
  public static final AngularVelocityUnit RotationsPerSecond = null;
  public static final AngularVelocityUnit RPM = null;
  public static final AngularVelocityUnit RadiansPerSecond = null;
  public static final AngularVelocityUnit DegreesPerSecond = null;
  public static final LinearAccelerationUnit MetersPerSecondPerSecond = null;
  public static final LinearAccelerationUnit FeetPerSecondPerSecond = null;
  public static final AngularAccelerationUnit RotationsPerSecondPerSecond = null;
  public static final AngularAccelerationUnit RadiansPerSecondPerSecond = null;
  public static final AngularAccelerationUnit DegreesPerSecondPerSecond = null;
  public static final VoltageUnit Volts = null;
  public static final VoltageUnit Volt = null;
  public static final VoltageUnit Millivolts = null;
  public static final VoltageUnit Millivolt = null;
  public static final CurrentUnit Amps = null;
  public static final CurrentUnit Amp = null;
  public static final CurrentUnit Milliamps = null;
  public static final CurrentUnit Milliamp = null;
}
