package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.wpilibj.RobotBase;
import edu.wpi.first.wpilibj.motorcontrol.PWMSparkMax;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Another voltage in simulation: whether it is halved cannot be told. */
public class Ternary extends SubsystemBase {
  private static double timeout = 10;
  private final PWMSparkMax wheel = new PWMSparkMax(1);

  private final SysIdRoutine routine = new SysIdRoutine(
      new SysIdRoutine.Config(
          RobotBase.isReal() ? Volts.of(0.5).per(Second) : null,
          Volts.of(3.5),
          Seconds.of(timeout)),
      new SysIdRoutine.Mechanism(
          v -> wheel.setVoltage(RobotBase.isReal() ? v.in(Volts) : v.in(Volts) / 2), null, this));

  public static void shorten() {
    timeout /= 2;
  }
}
