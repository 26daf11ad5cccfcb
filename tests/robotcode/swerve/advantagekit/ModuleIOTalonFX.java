package frc.robot.subsystems.drive;

import com.ctre.phoenix6.controls.PositionVoltage;
import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.math.geometry.Rotation2d;

/** A module with two TalonFX. */
public class ModuleIOTalonFX implements ModuleIO {
  private final TalonFX driveTalon = new TalonFX(1);
  private final TalonFX turnTalon = new TalonFX(2);
  private final VoltageOut voltageRequest = new VoltageOut(0);
  private final PositionVoltage positionRequest = new PositionVoltage(0);

  @Override
  public void setDriveOpenLoop(double output) {
    driveTalon.setControl(voltageRequest.withOutput(output));
  }

  @Override
  public void setTurnPosition(Rotation2d rotation) {
    turnTalon.setControl(positionRequest.withPosition(rotation.getRotations()));
  }
}
