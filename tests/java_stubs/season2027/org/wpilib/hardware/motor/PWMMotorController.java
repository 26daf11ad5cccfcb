// Signatures of allwpilib main, commit 10171e2f (WPILib 2027, not released): wpilibj/src/main/java/org/wpilib/hardware/motor/PWMMotorController.java

package org.wpilib.hardware.motor;

public abstract class PWMMotorController implements MotorController {
  public native void setThrottle(double throttle);

  public native double getThrottle();

  public native void setInverted(boolean isInverted);

  public native boolean getInverted();

  public native void disable();

  public native void addFollower(PWMMotorController follower);
}
