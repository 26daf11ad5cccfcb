// Signatures of allwpilib v2026.2.2: wpilibj/src/generated/main/java/edu/wpi/first/wpilibj/motorcontrol/Spark.java

package edu.wpi.first.wpilibj.motorcontrol;

public class Spark extends PWMMotorController {
  public Spark(final int channel) {}
}
