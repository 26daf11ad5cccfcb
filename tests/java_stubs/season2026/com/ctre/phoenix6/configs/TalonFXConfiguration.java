// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/configs/TalonFXConfiguration.html

package com.ctre.phoenix6.configs;

public class TalonFXConfiguration {
  public FeedbackConfigs Feedback;

  public native TalonFXConfiguration withFeedback(FeedbackConfigs newFeedback);
}
