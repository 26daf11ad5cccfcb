import static edu.wpi.first.units.Units.*;

public class DutyCycle extends SubsystemBase {
  private final CANSparkMax m_left = new CANSparkMax(1, MotorType.kBrushless);
  private final CANSparkMax m_right = new CANSparkMax(2, MotorType.kBrushless);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(.5f).per(Second), Volts.of(35e-1), Seconds.of(10L)),
      new SysIdRoutine.Mechanism(
          (Voltage volts) -> {
            double share = volts.in(Volts) / 12.0;
            m_left.set(share);
            m_right.set(volts.in(Volts) / RobotController.getBatteryVoltage());
          },
          log -> {
            log.motor("left").voltage(Volts.of(m_left.getAppliedOutput() * m_left.getBusVoltage()))
                .linearPosition(Meters.of(m_left.getEncoder().getPosition()))
                .linearVelocity(MetersPerSecond.of(m_left.getEncoder().getVelocity()));
          },
          this));
}
