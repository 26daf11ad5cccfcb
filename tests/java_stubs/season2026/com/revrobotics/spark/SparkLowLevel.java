// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/spark/SparkLowLevel.html

package com.revrobotics.spark;

import edu.wpi.first.wpilibj.motorcontrol.MotorController;

public abstract class SparkLowLevel implements MotorController {
  public enum MotorType {
    kBrushed,
    kBrushless
  }
}
