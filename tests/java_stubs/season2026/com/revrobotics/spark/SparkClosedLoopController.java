// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/spark/SparkClosedLoopController.html

package com.revrobotics.spark;

import com.revrobotics.REVLibError;

public class SparkClosedLoopController {
  private SparkClosedLoopController() {}

  public native REVLibError setSetpoint(double setpoint, SparkBase.ControlType ctrl);

  public native REVLibError setReference(double value, SparkBase.ControlType ctrl);
}
