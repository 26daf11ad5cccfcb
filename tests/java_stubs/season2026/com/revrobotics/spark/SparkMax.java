// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/spark/SparkMax.html

package com.revrobotics.spark;

public class SparkMax extends SparkBase {
  public SparkMax(int deviceId, MotorType type) {}
}
