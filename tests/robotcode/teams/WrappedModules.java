package teams;

import static edu.wpi.first.units.Units.*;

import com.revrobotics.spark.SparkBase;
import com.revrobotics.spark.SparkBase.PersistMode;
import com.revrobotics.spark.SparkBase.ResetMode;
import com.revrobotics.spark.SparkLowLevel.MotorType;
import com.revrobotics.spark.SparkMax;
import com.revrobotics.spark.config.SparkMaxConfig;
import edu.wpi.first.math.geometry.Rotation2d;
import edu.wpi.first.math.kinematics.SwerveModulePosition;
import edu.wpi.first.math.kinematics.SwerveModuleState;
import edu.wpi.first.math.util.Units;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.Command;
import edu.wpi.first.wpilibj2.command.Commands;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Supplier;

abstract class SwerveMotor {
  public abstract void setVoltage(double volts);

  public abstract double getVoltage();

  public abstract double getPosition();

  public abstract double getVelocity();

  public abstract void setInverted(boolean inverted);

  public abstract void burn();

  public abstract void setReference(double setpoint);
}

class SparkMaxSwerve extends SwerveMotor {
  private final SparkMax motor;
  private final SparkMaxConfig cfg = new SparkMaxConfig();

  SparkMaxSwerve(int id, double factor) {
    motor = new SparkMax(id, MotorType.kBrushless);
    cfg.encoder.positionConversionFactor(factor).velocityConversionFactor(factor / 60.0);
  }

  @Override
  public void setInverted(boolean inverted) {
    cfg.inverted(inverted);
  }

  @Override
  public void setReference(double setpoint) {
    motor.getClosedLoopController().setReference(setpoint, SparkBase.ControlType.kPosition);
  }

  @Override
  public void burn() {
    motor.configure(cfg, SparkBase.ResetMode.kNoResetSafeParameters, PersistMode.kPersistParameters);
  }

  @Override
  public void setVoltage(double volts) {
    motor.setVoltage(volts);
  }

  @Override
  public double getVoltage() {
    return motor.getAppliedOutput() * motor.getBusVoltage();
  }

  @Override
  public double getPosition() {
    return motor.getEncoder().getPosition();
  }

  @Override
  public double getVelocity() {
    return motor.getEncoder().getVelocity();
  }
}

record ModuleConfig(String name, int driveId, int angleId, boolean driveInverted) {
  ModuleConfig {
    if (driveId == angleId) {
      throw new IllegalArgumentException("ids must differ: " + driveId);
    }
  }
}

class SwerveModule {
  final String name;
  final SwerveMotor drive;
  final SwerveMotor angle;

  SwerveModule(ModuleConfig config) {
    name = config.name();
    drive = new SparkMaxSwerve(config.driveId(), Units.inchesToMeters(4) * Math.PI / 6.12);
    angle = new SparkMaxSwerve(config.angleId(), 2 * Math.PI / 12.8);
    drive.setInverted(config.driveInverted());
    drive.burn();
    angle.burn();
  }

  Rotation2d heading() {
    return Rotation2d.fromRadians(angle.getPosition());
  }

  SwerveModulePosition getPosition() {
    return new SwerveModulePosition(drive.getPosition(), heading());
  }

  SwerveModuleState getState() {
    return new SwerveModuleState(drive.getVelocity(), heading());
  }
}

public class WrappedModules extends SubsystemBase {
  private static final List<ModuleConfig> CONFIGS =
      List.of(
          new ModuleConfig("frontleft", 1, 2, false),
          new ModuleConfig("frontright", 3, 4, true),
          new ModuleConfig("backleft", 5, 6, false),
          new ModuleConfig("backright", 7, 8, true));

  private final Map<String, SwerveModule> modules = new LinkedHashMap<>();

  public WrappedModules() {
    CONFIGS.forEach(c -> modules.put(c.name(), new SwerveModule(c)));
  }

  private final SysIdRoutine driveRoutine = setDriveSysIdRoutine(this, 3.5);

  static SysIdRoutine setDriveSysIdRoutine(WrappedModules swerve, double maxVolts) {
    return new SysIdRoutine(
        new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(maxVolts), Seconds.of(10)),
        new SysIdRoutine.Mechanism(
            (Voltage voltage) -> swerve.modules.values().forEach(m -> powerDrive(m, voltage.in(Volts))),
            log -> {
              for (Map.Entry<String, SwerveModule> entry : swerve.modules.entrySet()) {
                logDriveMotor(log, entry.getKey(), entry.getValue());
              }
            },
            swerve));
  }

  private static void powerDrive(SwerveModule module, double volts) {
    module.angle.setReference(0.0);
    module.drive.setVoltage(volts);
  }

  private static void logDriveMotor(SysIdRoutineLog log, String name, SwerveModule module) {
    SwerveModulePosition position = module.getPosition();
    SwerveModuleState state = module.getState();
    log.motor("drive-" + name)
        .voltage(Volts.of(module.drive.getVoltage()))
        .linearPosition(Meters.of(position.distanceMeters))
        .linearVelocity(MetersPerSecond.of(state.speedMetersPerSecond));
  }

  public Command sysIdDriveMotorCommand() {
    return generateSysIdCommand(() -> driveRoutine, 3.0, 5.0, 3.0);
  }

  private static Command generateSysIdCommand(
      Supplier<SysIdRoutine> routine, double delay, double quasiTimeout, double dynamicTimeout) {
    SysIdRoutine r = routine.get();
    return r.quasistatic(SysIdRoutine.Direction.kForward)
        .withTimeout(quasiTimeout)
        .andThen(Commands.waitSeconds(delay))
        .andThen(r.quasistatic(SysIdRoutine.Direction.kReverse).withTimeout(quasiTimeout))
        .andThen(Commands.waitSeconds(delay))
        .andThen(r.dynamic(SysIdRoutine.Direction.kForward).withTimeout(dynamicTimeout))
        .andThen(Commands.waitSeconds(delay))
        .andThen(r.dynamic(SysIdRoutine.Direction.kReverse).withTimeout(dynamicTimeout));
  }
}
