package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.Command;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** The routine is put together in a method, from variables. */
public class LocalParts extends SubsystemBase {
  private final TalonFX m_arm = new TalonFX(12);

  private SysIdRoutine makeRoutine() {
    var ramp = Volts.of(0.5).per(Second);
    var step = Volts.of(3.5);
    var timeout = Seconds.of(10);
    var config = new SysIdRoutine.Config(ramp, step, timeout);
    var mechanism = new SysIdRoutine.Mechanism(
        volts -> {
          double output = volts.in(Volts);
          m_arm.setVoltage(output);
        },
        null,
        this);
    return new SysIdRoutine(config, mechanism);
  }

  public Command quasistaticForward() {
    return makeRoutine().quasistatic(SysIdRoutine.Direction.kForward);
  }
}
