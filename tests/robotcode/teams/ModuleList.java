package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import java.util.Arrays;

/** Swerve without a library: modules in an array, a stream over them. */
public class ModuleList extends SubsystemBase {
  private static class Module {
    private final TalonFX driveMotor;
    private final String name;

    Module(String name, int id) {
      this.name = name;
      driveMotor = new TalonFX(id);
    }

    void setDriveVoltage(double volts) {
      driveMotor.setVoltage(volts);
    }
  }

  private final Module frontLeft = new Module("front-left", 1);
  private final Module frontRight = new Module("front-right", 2);
  private final Module[] modules = new Module[] {frontLeft, frontRight};

  private final SysIdRoutine routine = new SysIdRoutine(
      new SysIdRoutine.Config(null, Volts.of(4), null),
      new SysIdRoutine.Mechanism(
          volts -> Arrays.stream(modules).forEach(module -> module.setDriveVoltage(volts.in(Volts))),
          log -> {
            for (Module module : modules) {
              log.motor(module.name)
                  .voltage(module.driveMotor.getMotorVoltage().getValue())
                  .linearPosition(Meters.of(module.driveMotor.getPosition().getValueAsDouble()))
                  .linearVelocity(
                      MetersPerSecond.of(module.driveMotor.getVelocity().getValueAsDouble()));
            }
          },
          this));
}
