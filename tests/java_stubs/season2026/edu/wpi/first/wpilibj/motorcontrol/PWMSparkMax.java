// Signatures of allwpilib v2026.2.2: wpilibj/src/generated/main/java/edu/wpi/first/wpilibj/motorcontrol/PWMSparkMax.java

package edu.wpi.first.wpilibj.motorcontrol;

public class PWMSparkMax extends PWMMotorController {
  public PWMSparkMax(final int channel) {}
}
