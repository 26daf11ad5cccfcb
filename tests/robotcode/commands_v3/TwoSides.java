package first.robot.mechanisms;

import static org.wpilib.units.Units.Meters;
import static org.wpilib.units.Units.MetersPerSecond;
import static org.wpilib.units.Units.Second;
import static org.wpilib.units.Units.Seconds;
import static org.wpilib.units.Units.Volts;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Command;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.sysid.SysIdRoutineLog;
import org.wpilib.units.measure.Voltage;

/** A drivetrain with two sides, as the documentation of Commands v3 would have it. */
public class TwoSides extends Mechanism {
  private static final double METERS_PER_TURN = 0.0472;

  private final TalonFX m_left = new TalonFX(1);
  private final TalonFX m_right = new TalonFX(2);
  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.SysIdMechanism(this::drive, this::record, this));

  private void drive(Voltage voltage) {
    m_left.setVoltage(voltage.in(Volts));
    m_right.setVoltage(voltage.in(Volts));
  }

  private void record(SysIdRoutineLog log) {
    log.motor("left")
        .voltage(m_left.getMotorVoltage().getValue())
        .linearPosition(Meters.of(m_left.getPosition().getValueAsDouble() * METERS_PER_TURN))
        .linearVelocity(
            MetersPerSecond.of(m_left.getVelocity().getValueAsDouble() * METERS_PER_TURN));
    log.motor("right")
        .voltage(m_right.getMotorVoltage().getValue())
        .linearPosition(Meters.of(m_right.getPosition().getValueAsDouble() * METERS_PER_TURN))
        .linearVelocity(
            MetersPerSecond.of(m_right.getVelocity().getValueAsDouble() * METERS_PER_TURN));
  }

  public Command quasistatic(SysIdRoutine.Direction direction) {
    return m_routine.quasistatic(direction);
  }

  public Command dynamic(SysIdRoutine.Direction direction) {
    return m_routine.dynamic(direction);
  }
}
