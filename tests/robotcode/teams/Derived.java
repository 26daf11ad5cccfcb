package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** The motor, the callbacks and the step come from the class above. */
public final class Derived extends BaseWithMotors {
  private final TalonFX extra = new TalonFX(9);
  private final SysIdRoutine routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(STEP), Seconds.of(10)),
          new SysIdRoutine.Mechanism(
              v -> {
                super.run(v);
                extra.setVoltage(v.in(Volts));
              },
              log -> describe(log, "rollers"),
              this));

  public Derived() {
    super(8);
  }
}
