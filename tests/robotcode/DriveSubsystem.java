import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.*;
import edu.wpi.first.wpilibj2.command.Command;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import static edu.wpi.first.units.Units.*;

public class DriveSubsystem extends SubsystemBase {
  private final TalonFX m_leftLeader = new TalonFX(1);
  private final TalonFX m_rightLeader = new TalonFX(2);

  private final SysIdRoutine m_sysIdRoutine = new SysIdRoutine(
    new SysIdRoutine.Config(
      Volts.of(0.5).per(Second), // quasistatic ramp rate: 0.5 V/s
      Volts.of(3.0), // dynamic step voltage: 3 V
      Seconds.of(10), // test timeout: 10 s
      null // use default state consumer (logs to DS)
    ),
    new SysIdRoutine.Mechanism(
      // Drive mechanism: apply voltage to both sides symmetrically
      (voltage) -> {
        m_leftLeader.setVoltage(voltage.in(Volts));
        m_rightLeader.setVoltage(voltage.in(Volts));
      },
      // Log mechanism state each loop for regression
      (log) -> {
        log.motor("drive-left")
          .voltage(Volts.of(m_leftLeader.getMotorVoltage().getValueAsDouble()))
          .linearPosition(Meters.of(getLeftPositionMeters()))
          .linearVelocity(MetersPerSecond.of(getLeftVelocityMetersPerSecond()));
        log.motor("drive-right")
          .voltage(Volts.of(m_rightLeader.getMotorVoltage().getValueAsDouble()))
          .linearPosition(Meters.of(getRightPositionMeters()))
          .linearVelocity(MetersPerSecond.of(getRightVelocityMetersPerSecond()));
      },
      this
    )
  );

  // The lesson leaves these four out.
  private double getLeftPositionMeters() {
    return m_leftLeader.getPosition().getValueAsDouble() * 0.0472;
  }
  private double getRightPositionMeters() {
    return m_rightLeader.getPosition().getValueAsDouble() * 0.0472;
  }
  private double getLeftVelocityMetersPerSecond() {
    return m_leftLeader.getVelocity().getValueAsDouble() * 0.0472;
  }
  private double getRightVelocityMetersPerSecond() {
    return m_rightLeader.getVelocity().getValueAsDouble() * 0.0472;
  }

  // Expose the four test commands for binding in RobotContainer
  public Command sysIdQuasistaticForward() {
    return m_sysIdRoutine.quasistatic(SysIdRoutine.Direction.kForward);
  }
  public Command sysIdQuasistaticReverse() {
    return m_sysIdRoutine.quasistatic(SysIdRoutine.Direction.kReverse);
  }
  public Command sysIdDynamicForward() {
    return m_sysIdRoutine.dynamic(SysIdRoutine.Direction.kForward);
  }
  public Command sysIdDynamicReverse() {
    return m_sysIdRoutine.dynamic(SysIdRoutine.Direction.kReverse);
  }
}
