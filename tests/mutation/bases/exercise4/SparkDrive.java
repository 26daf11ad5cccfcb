package frc.robot.subsystems;

import static edu.wpi.first.units.Units.Meters;
import static edu.wpi.first.units.Units.MetersPerSecond;
import static edu.wpi.first.units.Units.Second;
import static edu.wpi.first.units.Units.Seconds;
import static edu.wpi.first.units.Units.Volts;

import com.revrobotics.RelativeEncoder;
import com.revrobotics.spark.SparkLowLevel.MotorType;
import com.revrobotics.spark.SparkMax;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** A drivetrain with two Spark Max, whose encoders report rotations and rotations per minute. */
public class SparkDrive extends SubsystemBase {
  private static final double WHEEL_DIAMETER = 0.1524;
  private static final double GEARING = 10.71;
  private static final double METERS_PER_TURN = Math.PI * WHEEL_DIAMETER / GEARING;

  private final SparkMax m_left = new SparkMax(1, MotorType.kBrushless);
  private final SparkMax m_right = new SparkMax(2, MotorType.kBrushless);
  private final RelativeEncoder m_leftEncoder = m_left.getEncoder();
  private final RelativeEncoder m_rightEncoder = m_right.getEncoder();

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.Mechanism(this::drive, this::record, this));

  private void drive(Voltage voltage) {
    m_left.setVoltage(voltage.in(Volts));
    m_right.setVoltage(voltage.in(Volts));
  }

  private void record(SysIdRoutineLog log) {
    log.motor("left")
        .voltage(Volts.of(m_left.getAppliedOutput() * m_left.getBusVoltage()))
        .linearPosition(Meters.of(m_leftEncoder.getPosition() * METERS_PER_TURN))
        .linearVelocity(MetersPerSecond.of(m_leftEncoder.getVelocity() / 60.0 * METERS_PER_TURN));
    log.motor("right")
        .voltage(Volts.of(m_right.getAppliedOutput() * m_right.getBusVoltage()))
        .linearPosition(Meters.of(m_rightEncoder.getPosition() * METERS_PER_TURN))
        .linearVelocity(MetersPerSecond.of(m_rightEncoder.getVelocity() / 60.0 * METERS_PER_TURN));
  }
}
