package frc.robot.subsystems.drive;

import com.ctre.phoenix6.swerve.SwerveModuleConstants;

/** The module on the robot; the simulated one extends the same class. */
public class ModuleIOTalonFXSim extends ModuleIOTalonFX {
  public ModuleIOTalonFXSim(SwerveModuleConstants<?, ?, ?> constants) {
    super(constants);
  }

  @Override
  public void setDriveOpenLoop(double output) {
    driveTalon.setPosition(output);
  }
}
