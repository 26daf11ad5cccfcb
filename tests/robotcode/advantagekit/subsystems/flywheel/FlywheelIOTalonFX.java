package subsystems.flywheel;

import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.TalonFX;

/** The motor's side of it: no routine in this file. */
public class FlywheelIOTalonFX implements FlywheelIO {
  private final TalonFX leader = new TalonFX(0);

  @Override
  public void updateInputs(FlywheelIOInputs inputs) {
    inputs.appliedVolts = leader.getMotorVoltage().getValueAsDouble();
  }

  @Override
  public void setVoltage(double volts) {
    leader.setControl(new VoltageOut(volts));
  }
}
