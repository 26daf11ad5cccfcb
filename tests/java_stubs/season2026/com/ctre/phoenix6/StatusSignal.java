// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/StatusSignal.html

package com.ctre.phoenix6;

public class StatusSignal<T> extends BaseStatusSignal {
  private StatusSignal() {}

  public native T getValue();

  public native StatusSignal<T> refresh();
}
