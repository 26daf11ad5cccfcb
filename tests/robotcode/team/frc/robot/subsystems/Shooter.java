package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import frc.robot.Constants.ShooterConstants;

public class Shooter extends RollerBase {
  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(
          Volts.of(ShooterConstants.kRamp).per(Second),
          Volts.of(frc.robot.Constants.ShooterConstants.kStep),
          ShooterConstants.kTimeout),
      new SysIdRoutine.Mechanism(
          (Voltage v) -> applyVoltage(v),
          log -> log.motor("wheel")
              .voltage(m_roller.getMotorVoltage().getValue())
              .angularPosition(m_roller.getPosition().getValue())
              .angularVelocity(m_roller.getVelocity().getValue()),
          Shooter.this));
}
