package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.wpilibj.motorcontrol.PWMSparkMax;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Numbers in an enum's constructor, as some teams keep all of theirs. */
public class EnumSteps extends SubsystemBase {
  enum Test {
    CAREFUL(2.0),
    BOLD(3.5);

    final double volts;

    Test(double volts) {
      this.volts = volts;
    }
  }

  interface Limits {
    double RAMP = .5;
    int SECONDS = 10;
  }

  private final PWMSparkMax wheel = new PWMSparkMax(1);

  private final SysIdRoutine routine = new SysIdRoutine(
      new SysIdRoutine.Config(
          Volts.of(Limits.RAMP).per(Second), Volts.of(Test.BOLD.volts), Seconds.of(Limits.SECONDS)),
      new SysIdRoutine.Mechanism(wheel::setVoltage, log -> {}, this));
}
