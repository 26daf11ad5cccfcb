package frc.robot.subsystems.swervedrive;

import static edu.wpi.first.units.Units.*;

import com.revrobotics.spark.SparkLowLevel.MotorType;
import com.revrobotics.spark.SparkMax;
import edu.wpi.first.wpilibj.RobotController;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Two drive motors of a YAGSL robot by hand: the applied output times the battery is logged. */
public class FourSparks extends SubsystemBase {
  private final SparkMax left = new SparkMax(1, MotorType.kBrushless);
  private final SparkMax right = new SparkMax(3, MotorType.kBrushless);

  private final SysIdRoutine routine = new SysIdRoutine(
      new SysIdRoutine.Config(null, Volts.of(4), Seconds.of(6)),
      new SysIdRoutine.Mechanism(
          volts -> {
            left.setVoltage(volts);
            right.setVoltage(volts);
          },
          log -> log.motor("left")
              .voltage(Volts.of(left.getAppliedOutput() * RobotController.getBatteryVoltage()))
              .linearPosition(Meters.of(left.getEncoder().getPosition()))
              .linearVelocity(MetersPerSecond.of(left.getEncoder().getVelocity())),
          this));
}
