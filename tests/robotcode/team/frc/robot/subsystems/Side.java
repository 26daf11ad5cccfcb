package frc.robot.subsystems;

class Side {
  private final TalonFX m_motor;

  Side(int id) {
    m_motor = new TalonFX(id);
  }

  void setVoltage(double volts) {
    m_motor.set(volts / 12);
  }

  double volts() {
    return m_motor.getMotorVoltage().getValueAsDouble();
  }
}
