import static edu.wpi.first.units.Units.*;

public class ManyMotors extends SubsystemBase {
  private final TalonFX m_frontLeft = new TalonFX(1), m_backLeft = new TalonFX(2);
  private final TalonFX m_frontRight = new TalonFX(3);
  private final TalonFX m_backRight = new TalonFX(4);
  private final TalonFX[] m_left = {m_frontLeft, m_backLeft};
  private final List<TalonFX> m_right = List.of(m_frontRight, m_backRight);
  private final TalonFX[] m_rollers = new TalonFX[] {new TalonFX(5), new TalonFX(6)};

  private final Consumer<Voltage> m_driver = v -> {
    for (TalonFX motor : m_left) {
      motor.setVoltage(v.in(Volts));
    }
    m_right.forEach(motor -> motor.setVoltage(v.in(Volts)));
    for (int i = 0; i < m_rollers.length; i++) {
      if (i % 2 == 0) {
        m_rollers[i].setVoltage(v.in(Volts));
      }
    }
  };

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(),
      new SysIdRoutine.Mechanism(
          m_driver,
          new Consumer<SysIdRoutineLog>() {
            @Override
            public void accept(SysIdRoutineLog log) {
              logSide(log, "left", m_frontLeft);
              logSide(log, "right", m_frontRight);
            }
          },
          this));

  private static void logSide(SysIdRoutineLog log, String name, TalonFX motor) {
    log.motor(name)
        .voltage(motor.getMotorVoltage().getValue())
        .linearPosition(Inches.of(motor.getPosition().getValueAsDouble()))
        .linearVelocity(Rotations.per(Second).of(motor.getVelocity().getValueAsDouble()));
  }
}
