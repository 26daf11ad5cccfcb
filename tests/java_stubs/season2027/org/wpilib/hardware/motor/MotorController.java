// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): wpilibj/src/main/java/org/wpilib/hardware/motor/MotorController.java

package org.wpilib.hardware.motor;

import org.wpilib.units.measure.Voltage;

public interface MotorController {
  void setThrottle(double throttle);

  default void setVoltage(double volts) {}

  default void setVoltage(Voltage voltage) {}

  double getThrottle();

  void setInverted(boolean isInverted);

  boolean getInverted();

  void disable();
}
