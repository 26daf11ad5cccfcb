package frc.robot;

import static edu.wpi.first.units.Units.*;

public final class Constants {
  public static final double kStep = 99;

  public static final class ShooterConstants {
    public static final double kRamp = 0.25 * 2;
    public static final double kStep = kRamp * 7;
    public static final Time kTimeout = Seconds.of(10);
  }
}
