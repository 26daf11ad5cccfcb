// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/configs/FeedbackConfigs.html

package com.ctre.phoenix6.configs;

public class FeedbackConfigs {
  public double SensorToMechanismRatio;

  public native FeedbackConfigs withSensorToMechanismRatio(double newSensorToMechanismRatio);
}
