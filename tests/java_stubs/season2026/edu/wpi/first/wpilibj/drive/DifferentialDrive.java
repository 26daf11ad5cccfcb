// Signatures of allwpilib v2026.2.2: wpilibj/src/main/java/edu/wpi/first/wpilibj/drive/DifferentialDrive.java

package edu.wpi.first.wpilibj.drive;

import edu.wpi.first.wpilibj.motorcontrol.MotorController;
import java.util.function.DoubleConsumer;

public class DifferentialDrive {
  public DifferentialDrive(MotorController leftMotor, MotorController rightMotor) {}

  public DifferentialDrive(DoubleConsumer leftMotor, DoubleConsumer rightMotor) {}

  public native void arcadeDrive(double xSpeed, double zRotation);

  public native void feed();
}
