// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/configs/TalonFXConfigurator.html

package com.ctre.phoenix6.configs;

import com.ctre.phoenix6.StatusCode;

public class TalonFXConfigurator {
  private TalonFXConfigurator() {}

  public native StatusCode apply(TalonFXConfiguration configs);

  public native StatusCode apply(FeedbackConfigs configs);
}
