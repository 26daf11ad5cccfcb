package frc.robot;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.units.measure.Time;

/** All numbers of the robot. */
public final class Constants {
  public static final int kTwo = 2;

  public static final class ArmConstants {
    public static final double kRampVoltsPerSecond = 0.25 * kTwo;
    public static final int kSeven = 7;
    public static final Time kSysIdTimeout = Seconds.of(10);
    public static final int kMotorId = 8;

    private ArmConstants() {}
  }

  private Constants() {}
}
