package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import java.util.List;

/** Records, text blocks, switch expressions, patterns: what came into Java since version 11. */
public class Modern extends SubsystemBase {
  private record Side(String name, TalonFX motor) {}

  private enum Speed { SLOW, FAST }

  private static final String HELP = """
      new SysIdRoutine(new SysIdRoutine.Config(), null) is "not" code here
      """;

  private final Speed m_speed = Speed.SLOW;
  private final TalonFX m_left = new TalonFX(1);
  private final TalonFX m_right = new TalonFX(2);
  private final List<TalonFX> m_both = List.of(m_left, m_right);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(
          Volts.of(0.5).per(Second),
          switch (m_speed) {
            case SLOW -> Volts.of(2);
            case FAST -> Volts.of(6);
          },
          Seconds.of(10)),
      new SysIdRoutine.Mechanism(
          volts -> m_both.forEach(motor -> motor.setVoltage(volts.in(Volts))),
          null,
          this));

  private static double number(Object given) {
    return given instanceof Voltage volts ? volts.in(Volts) : 0;
  }
}
