package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import com.revrobotics.spark.SparkBase.ControlType;
import com.revrobotics.spark.SparkClosedLoopController;
import com.revrobotics.spark.SparkLowLevel.MotorType;
import com.revrobotics.spark.SparkMax;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;

/** REV's controller takes a voltage, too; the numbers are the library's constants and one of ours. */
public class SparkSetpoint extends Mechanism {
  private final SparkMax m_wrist = new SparkMax(9, MotorType.kBrushless);
  private final SparkClosedLoopController m_loop = m_wrist.getClosedLoopController();

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(
              SysIdRoutine.Config.DEFAULT_RAMP_RATE,
              SysIdRoutine.Config.DEFAULT_STEP_VOLTAGE,
              Seconds.of(3)),
          new SysIdRoutine.SysIdMechanism(
              volts -> m_loop.setSetpoint(volts.in(Volts), ControlType.kVoltage),
              log ->
                  log.motor("wrist")
                      .voltage(Volts.of(m_wrist.getAppliedOutput() * m_wrist.getBusVoltage()))
                      .angularPosition(Degrees.of(m_wrist.getAbsoluteEncoder().getPosition()))
                      .angularVelocity(
                          DegreesPerSecond.of(m_wrist.getAbsoluteEncoder().getVelocity())),
              this));
}
