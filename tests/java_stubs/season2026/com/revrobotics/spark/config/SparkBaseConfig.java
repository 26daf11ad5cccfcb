// Signatures of REVLib 2026: https://codedocs.revrobotics.com/java/com/revrobotics/spark/config/SparkBaseConfig.html

package com.revrobotics.spark.config;

import com.revrobotics.spark.SparkBase;

public abstract class SparkBaseConfig {
  public native SparkBaseConfig apply(SparkBaseConfig config);

  public native SparkBaseConfig follow(SparkBase leader, boolean invert);

  public native SparkBaseConfig inverted(boolean inverted);

  public native SparkBaseConfig smartCurrentLimit(int limit);

  public native SparkBaseConfig voltageCompensation(double nominalVoltage);
}
