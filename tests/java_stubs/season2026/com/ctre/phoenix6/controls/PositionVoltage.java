// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/controls/PositionVoltage.html

package com.ctre.phoenix6.controls;

import edu.wpi.first.units.measure.Angle;

public class PositionVoltage extends ControlRequest {
  public double Position;

  public PositionVoltage(double position) {}

  public PositionVoltage(Angle position) {}

  public native PositionVoltage withPosition(double newPosition);

  public native PositionVoltage withPosition(Angle newPosition);

  public native PositionVoltage withEnableFOC(boolean newEnableFOC);
}
