package frc.robot.subsystems.drive;

/** A module that is only simulated. */
public class ModuleIOSim implements ModuleIO {
  private double driveAppliedVolts = 0.0;
  private double driveVelocity = 0.0;

  @Override
  public void updateInputs(ModuleIOInputs inputs) {
    driveVelocity += 0.1 * (driveAppliedVolts - driveVelocity);
    inputs.driveVelocityRadPerSec = driveVelocity;
  }

  @Override
  public void setDriveOpenLoop(double output) {
    driveAppliedVolts = output;
  }
}
