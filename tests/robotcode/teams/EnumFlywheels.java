package teams;

import static edu.wpi.first.units.Units.RPM;
import static edu.wpi.first.units.Units.Rotations;
import static edu.wpi.first.units.Units.Seconds;
import static edu.wpi.first.units.Units.Volts;

import com.revrobotics.PersistMode;
import com.revrobotics.RelativeEncoder;
import com.revrobotics.ResetMode;
import com.revrobotics.spark.SparkFlex;
import com.revrobotics.spark.SparkLowLevel.MotorType;
import com.revrobotics.spark.config.SparkBaseConfig.IdleMode;
import com.revrobotics.spark.config.SparkFlexConfig;
import edu.wpi.first.units.measure.MutAngle;
import edu.wpi.first.units.measure.MutAngularVelocity;
import edu.wpi.first.units.measure.MutVoltage;
import edu.wpi.first.wpilibj.RobotController;
import edu.wpi.first.wpilibj2.command.Command;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine.Config;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine.Direction;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine.Mechanism;

public class EnumFlywheels extends SubsystemBase {
  private enum Wheel {
    TOP(21, false),
    BOTTOM(22, true);

    final int canId;
    final boolean inverted;

    Wheel(int canId, boolean inverted) {
      this.canId = canId;
      this.inverted = inverted;
    }

    String logName() {
      return "shooter-" + name().toLowerCase();
    }
  }

  private static final class Flywheel {
    final Wheel wheel;
    final SparkFlex motor;
    final RelativeEncoder encoder;
    private final MutVoltage volts = Volts.mutable(0);
    private final MutAngle angle = Rotations.mutable(0);
    private final MutAngularVelocity speed = RPM.mutable(0);

    Flywheel(Wheel wheel) {
      this.wheel = wheel;
      motor = new SparkFlex(wheel.canId, MotorType.kBrushless);
      SparkFlexConfig config = new SparkFlexConfig();
      config
          .inverted(wheel.inverted)
          .idleMode(IdleMode.kCoast)
          .smartCurrentLimit(60)
          .voltageCompensation(12.0);
      config.encoder.quadratureMeasurementPeriod(10).quadratureAverageDepth(2);
      config.signals.primaryEncoderPositionPeriodMs(10).primaryEncoderVelocityPeriodMs(10);
      motor.configure(config, ResetMode.kResetSafeParameters, PersistMode.kPersistParameters);
      encoder = motor.getEncoder();
    }

    void log(edu.wpi.first.wpilibj.sysid.SysIdRoutineLog log) {
      log.motor(wheel.logName())
          .voltage(volts.mut_replace(motor.getAppliedOutput() * motor.getBusVoltage(), Volts))
          .angularPosition(angle.mut_replace(encoder.getPosition(), Rotations))
          .angularVelocity(speed.mut_replace(encoder.getVelocity(), RPM));
    }
  }

  private final Flywheel[] wheels =
      java.util.Arrays.stream(Wheel.values()).map(Flywheel::new).toArray(Flywheel[]::new);

  private final SysIdRoutine routine =
      new SysIdRoutine(
          new Config(Volts.of(0.5).per(Seconds), Volts.of(3.5), Seconds.of(10)),
          new Mechanism(
              v -> {
                for (Flywheel w : wheels) w.motor.setVoltage(v);
              },
              log -> {
                for (Flywheel w : wheels) w.log(log);
              },
              this,
              "shooter"));

  public Command stop() {
    return runOnce(
        () -> {
          for (var w : wheels) {
            w.motor.stopMotor();
          }
        });
  }

  public Command sysIdQuasistatic(Direction direction) {
    return routine.quasistatic(direction).finallyDo(() -> wheels[0].motor.stopMotor());
  }

  public Command sysIdDynamic(Direction direction) {
    return routine.dynamic(direction).withName("EnumFlywheels SysId dynamic");
  }
}
