// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/BaseStatusSignal.html

package com.ctre.phoenix6;

public abstract class BaseStatusSignal {
  public native double getValueAsDouble();

  public static native StatusCode refreshAll(BaseStatusSignal... signals);
}
