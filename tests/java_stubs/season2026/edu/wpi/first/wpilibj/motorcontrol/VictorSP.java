// Signatures of allwpilib v2026.2.2: wpilibj/src/generated/main/java/edu/wpi/first/wpilibj/motorcontrol/VictorSP.java

package edu.wpi.first.wpilibj.motorcontrol;

public class VictorSP extends PWMMotorController {
  public VictorSP(final int channel) {}
}
