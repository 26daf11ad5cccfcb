package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.revrobotics.spark.SparkBase.ControlType;
import com.revrobotics.spark.SparkClosedLoopController;
import com.revrobotics.spark.SparkMax;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** REV's controller takes voltages, too, and calls it a setpoint since 2026. */
public class SetpointVoltage extends SubsystemBase {
  private final SparkMax m_wrist = new SparkMax(9, SparkMax.MotorType.kBrushless);
  private final SparkClosedLoopController m_loop = m_wrist.getClosedLoopController();

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(
          Volts.per(Second).of(0.5), Millivolts.of(3500), Milliseconds.of(10_000)),
      new SysIdRoutine.Mechanism(
          v -> m_loop.setSetpoint(v.in(Volts), ControlType.kVoltage),
          log -> log.motor("wrist")
              .voltage(Volts.of(m_wrist.getAppliedOutput() * m_wrist.getBusVoltage()))
              .angularPosition(Degrees.of(m_wrist.getAbsoluteEncoder().getPosition()))
              .angularVelocity(DegreesPerSecond.of(m_wrist.getAbsoluteEncoder().getVelocity())),
          this));
}
