package frc.robot.subsystems.drive;

import com.revrobotics.spark.SparkFlex;
import com.revrobotics.spark.SparkLowLevel.MotorType;

/** A module with a SPARK Flex. */
public class ModuleIOSpark implements ModuleIO {
  private final SparkFlex driveSpark = new SparkFlex(1, MotorType.kBrushless);

  @Override
  public void setDriveOpenLoop(double output) {
    driveSpark.set(output / 12.0);
  }
}
