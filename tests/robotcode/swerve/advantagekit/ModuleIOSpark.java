package frc.robot.subsystems.drive;

import com.revrobotics.spark.SparkLowLevel.MotorType;
import com.revrobotics.spark.SparkMax;

/** A module with a SPARK MAX. */
public class ModuleIOSpark implements ModuleIO {
  private final SparkMax driveSpark = new SparkMax(1, MotorType.kBrushless);

  @Override
  public void setDriveOpenLoop(double output) {
    driveSpark.setVoltage(output);
  }
}
