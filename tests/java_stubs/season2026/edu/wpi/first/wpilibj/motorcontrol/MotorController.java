// Signatures of allwpilib v2026.2.2: wpilibj/src/main/java/edu/wpi/first/wpilibj/motorcontrol/MotorController.java

package edu.wpi.first.wpilibj.motorcontrol;

import edu.wpi.first.units.measure.Voltage;

public interface MotorController {
  void set(double speed);

  default void setVoltage(double outputVolts) {}

  default void setVoltage(Voltage outputVoltage) {}

  double get();

  void setInverted(boolean isInverted);

  boolean getInverted();

  void disable();

  void stopMotor();
}
