package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.units.measure.Voltage;

/** Methods make the parts; a helper sends the voltage. */
public class MadeByMethods extends Mechanism {
  private final TalonFX m_left = new TalonFX(1);
  private final TalonFX m_right = new TalonFX(2);
  private final SysIdRoutine m_routine = new SysIdRoutine(settings(), tested());

  private static SysIdRoutine.Config settings() {
    return SysIdRoutine.Config.useDataLog(
        Volts.of(0.5).per(Second), Volts.of(7.0 / 2), Minutes.of(1).div(6));
  }

  private SysIdRoutine.SysIdMechanism tested() {
    return new SysIdRoutine.SysIdMechanism(this::both, null, this);
  }

  private void both(Voltage volts) {
    send(m_left, volts);
    send(m_right, volts);
  }

  private static void send(TalonFX motor, Voltage volts) {
    motor.setVoltage(volts.in(Volts));
  }
}
