// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/spark/SparkFlex.html

package com.revrobotics.spark;

public class SparkFlex extends SparkBase {
  public SparkFlex(int deviceId, MotorType type) {}
}
