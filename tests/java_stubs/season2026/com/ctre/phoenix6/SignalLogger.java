// Signatures of Phoenix 6 26.x: https://api.ctr-electronics.com/phoenix6/stable/java/com/ctre/phoenix6/SignalLogger.html

package com.ctre.phoenix6;

public final class SignalLogger {
  private SignalLogger() {}

  public static native StatusCode start();

  public static native StatusCode stop();

  public static native StatusCode writeString(String name, String value);

  public static native StatusCode writeDouble(String name, double value);
}
