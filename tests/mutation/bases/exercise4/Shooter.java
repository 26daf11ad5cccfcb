package frc.robot.subsystems;

import static edu.wpi.first.units.Units.Rotations;
import static edu.wpi.first.units.Units.RotationsPerSecond;
import static edu.wpi.first.units.Units.Second;
import static edu.wpi.first.units.Units.Seconds;
import static edu.wpi.first.units.Units.Volts;

import com.ctre.phoenix6.configs.TalonFXConfiguration;
import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Two flywheels whose motors report the rotations of the wheels, behind their gears. */
public class Shooter extends SubsystemBase {
  private static final double GEARING = 1.5;

  private final TalonFX m_top = new TalonFX(1);
  private final TalonFX m_bottom = new TalonFX(2);
  private final SysIdRoutine m_routine;

  public Shooter() {
    TalonFXConfiguration config = new TalonFXConfiguration();
    config.Feedback.SensorToMechanismRatio = GEARING;
    m_top.getConfigurator().apply(config);
    m_bottom.getConfigurator().apply(config);
    m_routine =
        new SysIdRoutine(
            new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
            new SysIdRoutine.Mechanism(this::drive, this::record, this));
  }

  private void drive(Voltage voltage) {
    m_top.setVoltage(voltage.in(Volts));
    m_bottom.setVoltage(voltage.in(Volts));
  }

  private void record(SysIdRoutineLog log) {
    log.motor("top")
        .voltage(m_top.getMotorVoltage().getValue())
        .angularPosition(Rotations.of(m_top.getPosition().getValueAsDouble()))
        .angularVelocity(RotationsPerSecond.of(m_top.getVelocity().getValueAsDouble()));
    log.motor("bottom")
        .voltage(m_bottom.getMotorVoltage().getValue())
        .angularPosition(Rotations.of(m_bottom.getPosition().getValueAsDouble()))
        .angularVelocity(RotationsPerSecond.of(m_bottom.getVelocity().getValueAsDouble()));
  }
}
