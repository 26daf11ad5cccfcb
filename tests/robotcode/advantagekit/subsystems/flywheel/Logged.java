package subsystems.flywheel;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** The same, and WPILib's log as well, from fields that the hardware layer fills. */
public class Logged extends SubsystemBase {
  private final FlywheelIO m_io;
  private final FlywheelIOInputsAutoLogged m_inputs = new FlywheelIOInputsAutoLogged();

  private final SysIdRoutine m_sysId =
      new SysIdRoutine(
          new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.Mechanism(
              voltage -> m_io.setVoltage(voltage.in(Volts)),
              log ->
                  log.motor("flywheel")
                      .voltage(Volts.of(m_inputs.appliedVolts))
                      .angularPosition(Radians.of(m_inputs.positionRad))
                      .angularVelocity(RadiansPerSecond.of(m_inputs.velocityRadPerSec)),
              this));

  public Logged(FlywheelIO io) {
    m_io = io;
  }
}
