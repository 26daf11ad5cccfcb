package first.robot.mechanisms;

import static org.wpilib.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.sysid.SysIdRoutineLog;
import org.wpilib.units.measure.Voltage;

/** A mistake: the log holds the voltage that was asked for. */
public class AskedIsLogged extends Mechanism {
  private final TalonFX m_climber = new TalonFX(40);
  private Voltage m_asked = Volts.zero();

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.SysIdMechanism(this::drive, this::record, this));

  private void drive(Voltage volts) {
    m_asked = volts;
    m_climber.setVoltage(volts.in(Volts));
  }

  private void record(SysIdRoutineLog log) {
    log.motor("climber")
        .voltage(m_asked)
        .angularPosition(m_climber.getPosition().getValue())
        .angularVelocity(m_climber.getVelocity().getValue());
  }
}
