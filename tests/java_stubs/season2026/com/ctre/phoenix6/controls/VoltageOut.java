// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/controls/VoltageOut.html

package com.ctre.phoenix6.controls;

import edu.wpi.first.units.measure.Voltage;

public class VoltageOut extends ControlRequest {
  public double Output;

  public VoltageOut(double output) {}

  public VoltageOut(Voltage output) {}

  public native VoltageOut withOutput(double newOutput);

  public native VoltageOut withOutput(Voltage newOutput);

  public native VoltageOut withEnableFOC(boolean newEnableFOC);
}
