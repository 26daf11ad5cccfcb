package frc.robot.subsystems.swervedrive;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import swervelib.SwerveDrive;
import swervelib.SwerveModule;

/** What the library does, written out: center the modules, drive them, log each in meters. */
public class CenteredModules extends SubsystemBase {
  private final SwerveDrive swerveDrive;
  private final SysIdRoutine routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3), Seconds.of(8)),
      new SysIdRoutine.Mechanism(
          voltage -> {
            for (SwerveModule module : swerveDrive.getModules()) {
              module.getAngleMotor().setReference(0, 0);
              module.getDriveMotor().setVoltage(voltage.in(Volts));
            }
          },
          log -> {
            for (SwerveModule module : swerveDrive.getModules()) {
              log.motor("drive-" + module.configuration.name)
                  .voltage(Volts.of(module.getDriveMotor().getVoltage()))
                  .linearPosition(Meters.of(module.getPosition().distanceMeters))
                  .linearVelocity(MetersPerSecond.of(module.getDriveMotor().getVelocity()));
            }
          },
          this));

  public CenteredModules(SwerveDrive swerveDrive) {
    this.swerveDrive = swerveDrive;
  }
}
