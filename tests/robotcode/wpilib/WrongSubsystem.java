package frc.robot;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import frc.robot.subsystems.Shooter;

/** A container of routines, not a subsystem; it drives and passes another object. */
public class WrongSubsystem {
  private final SysIdRoutine routine;

  public WrongSubsystem(Shooter shooter) {
    SysIdRoutine.Config config = new SysIdRoutine.Config(
        Volts.of(0.8).per(Second), Volts.of(6), Seconds.of(10));
    routine = new SysIdRoutine(
        config, new SysIdRoutine.Mechanism(shooter::setFlywheelVoltage, null, shooter));
  }
}
