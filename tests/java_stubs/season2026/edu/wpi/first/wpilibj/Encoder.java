// Signatures of allwpilib v2026.2.2: wpilibj/src/main/java/edu/wpi/first/wpilibj/Encoder.java

package edu.wpi.first.wpilibj;

public class Encoder {
  public Encoder(int channelA, int channelB) {}

  public Encoder(int channelA, int channelB, boolean reverseDirection) {}

  public native double getDistance();

  public native double getRate();

  public native void setDistancePerPulse(double distancePerPulse);
}
