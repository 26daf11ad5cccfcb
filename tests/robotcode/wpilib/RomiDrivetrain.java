package frc.robot.subsystems;

import edu.wpi.first.units.Units;
import edu.wpi.first.wpilibj.Encoder;
import edu.wpi.first.wpilibj.RobotController;
import edu.wpi.first.wpilibj.drive.DifferentialDrive;
import edu.wpi.first.wpilibj.motorcontrol.Spark;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** No static import: every unit has its class in front. */
public class RomiDrivetrain extends SubsystemBase {
  private final Spark m_leftMotor = new Spark(0);
  private final Spark m_rightMotor = new Spark(1);
  private final Encoder m_leftEncoder = new Encoder(4, 5);
  private final Encoder m_rightEncoder = new Encoder(6, 7);
  private final DifferentialDrive m_diffDrive = new DifferentialDrive(m_leftMotor::set, m_rightMotor::set);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(
          Units.Volts.of(0.5).per(Units.Second),
          Units.Volts.of(3),
          Units.Seconds.of(6)),
      new SysIdRoutine.Mechanism(
          voltage -> {
            m_leftMotor.setVoltage(voltage);
            m_rightMotor.setVoltage(voltage);
            m_diffDrive.feed();
          },
          log -> {
            log.motor("romi-left")
                .voltage(Units.Volts.of(m_leftMotor.get() * RobotController.getBatteryVoltage()))
                .linearPosition(Units.Meters.of(m_leftEncoder.getDistance()))
                .linearVelocity(Units.MetersPerSecond.of(m_leftEncoder.getRate()));
            log.motor("romi-right")
                .voltage(Units.Volts.of(m_rightMotor.get() * RobotController.getBatteryVoltage()))
                .linearPosition(Units.Meters.of(m_rightEncoder.getDistance()))
                .linearVelocity(Units.MetersPerSecond.of(m_rightEncoder.getRate()));
          },
          this));
}
