package frc.robot.subsystems.drive;

import com.ctre.phoenix6.controls.PositionVoltage;
import com.ctre.phoenix6.controls.TorqueCurrentFOC;
import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.TalonFX;
import com.ctre.phoenix6.swerve.SwerveModuleConstants;
import edu.wpi.first.math.geometry.Rotation2d;

/** A module with two TalonFX. */
public class ModuleIOTalonFX implements ModuleIO {
  protected final SwerveModuleConstants<?, ?, ?> constants;
  protected final TalonFX driveTalon;
  protected final TalonFX turnTalon;
  private final VoltageOut voltageRequest = new VoltageOut(0);
  private final PositionVoltage positionVoltageRequest = new PositionVoltage(0.0);
  private final TorqueCurrentFOC torqueCurrentRequest = new TorqueCurrentFOC(0);

  public ModuleIOTalonFX(SwerveModuleConstants<?, ?, ?> constants) {
    this.constants = constants;
    driveTalon = new TalonFX(constants.DriveMotorId, "canivore");
    turnTalon = new TalonFX(constants.SteerMotorId, "canivore");
  }

  @Override
  public void updateInputs(ModuleIOInputs inputs) {
    inputs.driveAppliedVolts = driveTalon.getMotorVoltage().getValueAsDouble();
  }

  @Override
  public void setDriveOpenLoop(double output) {
    driveTalon.setControl(
        switch (constants.DriveMotorClosedLoopOutput) {
          case Voltage -> voltageRequest.withOutput(output);
          case TorqueCurrentFOC -> torqueCurrentRequest.withOutput(output);
        });
  }

  @Override
  public void setTurnOpenLoop(double output) {
    turnTalon.setControl(voltageRequest.withOutput(output));
  }

  @Override
  public void setTurnPosition(Rotation2d rotation) {
    turnTalon.setControl(positionVoltageRequest.withPosition(rotation.getRotations()));
  }
}
