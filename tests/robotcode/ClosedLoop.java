import static edu.wpi.first.units.Units.*;

public class ClosedLoop extends SubsystemBase {
  private final TalonFX m_top = new TalonFX(1);
  private final TalonFX m_bottom = new TalonFX(2);
  private final SparkFlex m_feed = new SparkFlex(3, MotorType.kBrushless);
  private final VelocityVoltage m_velocity = new VelocityVoltage(0);
  private final PIDController m_pid = new PIDController(0.1, 0, 0);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(1).per(Seconds), Volts.of(4), Seconds.of(5)),
      new SysIdRoutine.Mechanism(
          v -> {
            m_top.setControl(m_velocity.withVelocity(v.in(Volts)));
            double effort = m_pid.calculate(m_bottom.getVelocity().getValueAsDouble(), v.in(Volts));
            m_bottom.setVoltage(effort);
            m_feed.getClosedLoopController().setReference(v.in(Volts), ControlType.kVelocity);
          },
          log -> {},
          this));
}
