// Signatures of allwpilib v2026.2.2: wpilibj/src/generated/main/java/edu/wpi/first/wpilibj/motorcontrol/Talon.java

package edu.wpi.first.wpilibj.motorcontrol;

public class Talon extends PWMMotorController {
  public Talon(final int channel) {}
}
