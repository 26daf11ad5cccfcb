// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): wpilibj/src/main/java/org/wpilib/hardware/rotation/Encoder.java

package org.wpilib.hardware.rotation;

public class Encoder {
  public Encoder(int channelA, int channelB) {}

  public native double getDistance();

  public native double getRate();
}
