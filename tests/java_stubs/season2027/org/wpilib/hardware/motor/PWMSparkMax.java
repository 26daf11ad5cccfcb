// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): wpilibj/src/generated/main/java/org/wpilib/hardware/motor/PWMSparkMax.java

package org.wpilib.hardware.motor;

public class PWMSparkMax extends PWMMotorController {
  public PWMSparkMax(final int channel) {}
}
