// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/hardware/CANcoder.html

package com.ctre.phoenix6.hardware;

import com.ctre.phoenix6.StatusSignal;
import edu.wpi.first.units.measure.Angle;
import edu.wpi.first.units.measure.AngularVelocity;

public class CANcoder {
  public CANcoder(int deviceId) {}

  public native StatusSignal<Angle> getPosition();

  public native StatusSignal<Angle> getAbsolutePosition();

  public native StatusSignal<AngularVelocity> getVelocity();
}
