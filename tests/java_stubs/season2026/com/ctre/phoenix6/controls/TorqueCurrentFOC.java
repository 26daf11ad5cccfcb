// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/controls/TorqueCurrentFOC.html

package com.ctre.phoenix6.controls;

import edu.wpi.first.units.measure.Current;

public class TorqueCurrentFOC extends ControlRequest {
  public double Output;

  public TorqueCurrentFOC(double output) {}

  public TorqueCurrentFOC(Current output) {}

  public native TorqueCurrentFOC withOutput(double newOutput);

  public native TorqueCurrentFOC withOutput(Current newOutput);
}
