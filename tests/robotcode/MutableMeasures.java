package frc.robot.subsystems;

import static edu.wpi.first.units.Units.Meters;
import static edu.wpi.first.units.Units.MetersPerSecond;
import static edu.wpi.first.units.Units.Volts;

import edu.wpi.first.units.measure.MutDistance;
import edu.wpi.first.units.measure.MutLinearVelocity;
import edu.wpi.first.units.measure.MutVoltage;
import edu.wpi.first.wpilibj.Encoder;
import edu.wpi.first.wpilibj.RobotController;
import edu.wpi.first.wpilibj.drive.DifferentialDrive;
import edu.wpi.first.wpilibj.motorcontrol.PWMSparkMax;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Tank drive with PWM controllers; the second motor of each side follows. */
public class MutableMeasures extends SubsystemBase {
  private final PWMSparkMax m_left = new PWMSparkMax(0);
  private final PWMSparkMax m_leftBack = new PWMSparkMax(1);
  private final PWMSparkMax m_right = new PWMSparkMax(2);
  private final PWMSparkMax m_rightBack = new PWMSparkMax(3);
  private final DifferentialDrive m_drive = new DifferentialDrive(m_left::set, m_right::set);
  private final Encoder m_leftEncoder = new Encoder(0, 1);
  private final Encoder m_rightEncoder = new Encoder(2, 3);

  // Made once, so that the garbage collector has nothing to do in the loop.
  private final MutVoltage m_applied = Volts.mutable(0);
  private final MutDistance m_distance = Meters.mutable(0);
  private final MutLinearVelocity m_speed = MetersPerSecond.mutable(0);

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(),
          new SysIdRoutine.Mechanism(
              voltage -> {
                m_left.setVoltage(voltage);
                m_right.setVoltage(voltage);
              },
              log -> {
                log.motor("left")
                    .voltage(
                        m_applied.mut_replace(
                            m_left.get() * RobotController.getBatteryVoltage(), Volts))
                    .linearPosition(m_distance.mut_replace(m_leftEncoder.getDistance(), Meters))
                    .linearVelocity(
                        m_speed.mut_replace(m_leftEncoder.getRate(), MetersPerSecond));
                log.motor("right")
                    .voltage(
                        m_applied.mut_replace(
                            m_right.get() * RobotController.getBatteryVoltage(), Volts))
                    .linearPosition(m_distance.mut_replace(m_rightEncoder.getDistance(), Meters))
                    .linearVelocity(
                        m_speed.mut_replace(m_rightEncoder.getRate(), MetersPerSecond));
              },
              this));

  public MutableMeasures() {
    m_left.addFollower(m_leftBack);
    m_right.addFollower(m_rightBack);
    m_right.setInverted(true);
  }
}
