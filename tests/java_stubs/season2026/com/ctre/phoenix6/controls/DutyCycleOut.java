// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/controls/DutyCycleOut.html

package com.ctre.phoenix6.controls;

public class DutyCycleOut extends ControlRequest {
  public double Output;

  public DutyCycleOut(double output) {}

  public native DutyCycleOut withOutput(double newOutput);

  public native DutyCycleOut withEnableFOC(boolean newEnableFOC);
}
