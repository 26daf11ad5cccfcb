package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import com.revrobotics.RelativeEncoder;
import com.revrobotics.spark.SparkLowLevel.MotorType;
import com.revrobotics.spark.SparkMax;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;

/** REV's motors: two of them, times in milliseconds, the drum's turns made meters. */
public class SparkElevator extends Mechanism {
  private static final double kMetersPerTurn = Math.PI * 0.0445 / 9;

  private final SparkMax m_leader = new SparkMax(5, MotorType.kBrushless);
  private final SparkMax m_other = new SparkMax(6, MotorType.kBrushless);
  private final RelativeEncoder m_encoder = m_leader.getEncoder();

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(
              Millivolts.of(500).per(Second), Volts.of(7).div(2), Milliseconds.of(8_000)),
          new SysIdRoutine.SysIdMechanism(
              volts -> {
                m_leader.setVoltage(volts);
                m_other.setVoltage(volts);
              },
              log ->
                  log.motor("elevator")
                      .voltage(Volts.of(m_leader.getAppliedOutput() * m_leader.getBusVoltage()))
                      .linearPosition(Meters.of(m_encoder.getPosition() * kMetersPerTurn))
                      .linearVelocity(
                          MetersPerSecond.of(m_encoder.getVelocity() / 60 * kMetersPerTurn)),
              this));
}
