package frc.robot.subsystems;

import static edu.wpi.first.units.Units.Meters;
import static edu.wpi.first.units.Units.MetersPerSecond;
import static edu.wpi.first.units.Units.Second;
import static edu.wpi.first.units.Units.Seconds;
import static edu.wpi.first.units.Units.Volts;

import com.revrobotics.RelativeEncoder;
import com.revrobotics.spark.SparkLowLevel.MotorType;
import com.revrobotics.spark.SparkMax;
import edu.wpi.first.math.util.Units;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine.Config;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine.Mechanism;

public class NeoElevator extends SubsystemBase {
  private static final double kGearing = 9.0;
  private static final double kMetersPerTurn = Units.inchesToMeters(1.75) * Math.PI / kGearing;

  private final SparkMax m_left = new SparkMax(1, MotorType.kBrushless);
  private final SparkMax m_right = new SparkMax(2, MotorType.kBrushless);
  private final RelativeEncoder m_leftEncoder = m_left.getEncoder();
  private final RelativeEncoder m_rightEncoder = m_right.getEncoder();

  private final Config m_config =
      new Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10));
  private final Mechanism m_mechanism = new Mechanism(this::drive, this::log, this);
  private final SysIdRoutine m_routine = new SysIdRoutine(m_config, m_mechanism);

  private void drive(Voltage volts) {
    final double value = volts.in(Volts);
    m_left.setVoltage(value);
    m_right.setVoltage(-value);
  }

  private void log(SysIdRoutineLog log) {
    logOne(log, "left", m_left, m_leftEncoder);
    logOne(log, "right", m_right, m_rightEncoder);
  }

  private void logOne(SysIdRoutineLog log, String name, SparkMax motor, RelativeEncoder encoder) {
    log.motor(name)
        .voltage(Volts.of(motor.getAppliedOutput() * motor.getBusVoltage()))
        .linearPosition(Meters.of(encoder.getPosition() * kMetersPerTurn))
        .linearVelocity(MetersPerSecond.of(encoder.getVelocity() / 60.0 * kMetersPerTurn));
  }
}
