import static edu.wpi.first.units.Units.*;

public class IntegerDivision extends SubsystemBase {
  static final int kTicks = 2_500;
  static final double kQuarter = 1 / 4; // 0.0: both are int
  private final TalonFX m_motor = new TalonFX(0x1F);
  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(
              Volts.of(kQuarter).per(Second),
              /* half of it */ Volts.of((double) 7 / 2).times(1.),
              Milliseconds.of(kTicks * 4),
              null),
          new SysIdRoutine.Mechanism(
              v -> m_motor.setVoltage(v.magnitude()),
              log ->
                  log.motor("roller")
                      .voltage(m_motor.getMotorVoltage().getValue())
                      .angularPosition(m_motor.getPosition().getValue())
                      .angularVelocity(m_motor.getVelocity().getValue()),
              this));
}
