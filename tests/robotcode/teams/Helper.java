package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj2.command.Subsystem;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import java.util.function.Consumer;

/** One method makes the routine of every mechanism; what it is given decides. */
public class Helper extends SubsystemBase {
  private final TalonFX hood = new TalonFX(5);
  private final SysIdRoutine hoodRoutine = routineOf(3.5, hood::setVoltage, this);

  static SysIdRoutine routineOf(double step, Consumer<Voltage> drive, Subsystem owner) {
    return new SysIdRoutine(
        new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(step), Seconds.of(10)),
        new SysIdRoutine.Mechanism(drive, null, owner));
  }
}
