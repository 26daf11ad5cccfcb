package frc.robot.subsystems.drive;

import edu.wpi.first.math.geometry.Rotation2d;
import edu.wpi.first.wpilibj.simulation.DCMotorSim;

/** A module that is only simulated. */
public class ModuleIOSim implements ModuleIO {
  private final DCMotorSim driveSim = new DCMotorSim(null, null);
  private double driveAppliedVolts = 0.0;

  @Override
  public void updateInputs(ModuleIOInputs inputs) {
    driveSim.setInputVoltage(driveAppliedVolts);
    driveSim.update(0.02);
  }

  @Override
  public void setDriveOpenLoop(double output) {
    driveAppliedVolts = output;
  }
}
