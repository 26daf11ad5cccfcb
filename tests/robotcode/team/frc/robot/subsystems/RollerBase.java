package frc.robot.subsystems;

public abstract class RollerBase extends SubsystemBase {
  protected final TalonFX m_roller = new TalonFX(20);

  protected void applyVoltage(double volts) {
    m_roller.setVoltage(MathUtil.clamp(volts, -12, 12));
  }

  protected void applyVoltage(Voltage voltage) {
    applyVoltage(voltage.in(Volts));
  }
}
