package first.robot.mechanisms;

import static org.wpilib.units.Units.Rotations;
import static org.wpilib.units.Units.RotationsPerSecond;
import static org.wpilib.units.Units.Second;
import static org.wpilib.units.Units.Seconds;
import static org.wpilib.units.Units.Volts;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Command;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.command3.sysid.SysIdRoutine.SysIdMechanism;

public class CommandsV3 extends Mechanism {
  private final TalonFX m_wheel = new TalonFX(7);

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          SysIdRoutine.Config.useDataLog(
              Volts.of(1).per(Second), Volts.of(4), SysIdRoutine.Config.DEFAULT_TIMEOUT),
          new SysIdMechanism(
              volts -> m_wheel.setVoltage(volts.in(Volts)),
              log ->
                  log.motor("wheel")
                      .voltage(Volts.of(m_wheel.getMotorVoltage().getValueAsDouble()))
                      .angularPosition(Rotations.of(m_wheel.getPosition().getValueAsDouble()))
                      .angularVelocity(
                          RotationsPerSecond.of(m_wheel.getVelocity().getValueAsDouble())),
              this,
              "shooter-wheel"));

  public Command spinUp() {
    return m_routine.dynamic(SysIdRoutine.Direction.FORWARD);
  }

  public Command hold(double volts) {
    return runRepeatedly(() -> m_wheel.setVoltage(volts)).named("hold");
  }
}
