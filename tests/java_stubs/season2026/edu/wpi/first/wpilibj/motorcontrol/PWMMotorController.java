// Signatures of allwpilib v2026.2.2: wpilibj/src/main/java/edu/wpi/first/wpilibj/motorcontrol/PWMMotorController.java

package edu.wpi.first.wpilibj.motorcontrol;

public abstract class PWMMotorController implements MotorController {
  public native void set(double speed);

  public native double get();

  public native void setInverted(boolean isInverted);

  public native boolean getInverted();

  public native void disable();

  public native void stopMotor();

  public native void addFollower(PWMMotorController follower);
}
