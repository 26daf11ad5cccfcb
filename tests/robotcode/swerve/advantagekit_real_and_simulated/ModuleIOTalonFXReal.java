package frc.robot.subsystems.drive;

import com.ctre.phoenix6.swerve.SwerveModuleConstants;

/** The module on the robot; the simulated one extends the same class. */
public class ModuleIOTalonFXReal extends ModuleIOTalonFX {
  public ModuleIOTalonFXReal(SwerveModuleConstants<?, ?, ?> constants) {
    super(constants);
  }
}
