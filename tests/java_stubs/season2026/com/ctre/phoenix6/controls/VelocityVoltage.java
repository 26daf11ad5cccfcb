// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/controls/VelocityVoltage.html

package com.ctre.phoenix6.controls;

import edu.wpi.first.units.measure.AngularVelocity;

public class VelocityVoltage extends ControlRequest {
  public double Velocity;

  public VelocityVoltage(double velocity) {}

  public VelocityVoltage(AngularVelocity velocity) {}

  public native VelocityVoltage withVelocity(double newVelocity);

  public native VelocityVoltage withVelocity(AngularVelocity newVelocity);

  public native VelocityVoltage withEnableFOC(boolean newEnableFOC);
}
