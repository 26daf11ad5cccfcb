// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/swerve/SwerveRequest.html

package com.ctre.phoenix6.swerve;

import edu.wpi.first.units.measure.Voltage;

public interface SwerveRequest {
  class SysIdSwerveTranslation implements SwerveRequest {
    public native SysIdSwerveTranslation withVolts(double volts);

    public native SysIdSwerveTranslation withVolts(Voltage volts);
  }

  class SysIdSwerveRotation implements SwerveRequest {
    public native SysIdSwerveRotation withRotationalRate(double rotationalRate);
  }

  class SysIdSwerveSteerGains implements SwerveRequest {
    public native SysIdSwerveSteerGains withVolts(double volts);

    public native SysIdSwerveSteerGains withVolts(Voltage volts);
  }
}
