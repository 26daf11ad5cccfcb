// Signatures of AdvantageKit v26: akit/src/main/java/org/littletonrobotics/junction/Logger.java

package org.littletonrobotics.junction;

public class Logger {
  private Logger() {}

  public static native void recordOutput(String key, String value);

  public static native void recordOutput(String key, double value);
}
