package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.revrobotics.spark.SparkMax;
import edu.wpi.first.wpilibj.RobotController;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Volts over battery volts: a duty cycle all the same. */
public class DutySpark extends SubsystemBase {
  private final SparkMax intake = new SparkMax(7, SparkMax.MotorType.kBrushless);

  private final SysIdRoutine routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(.5).div(Seconds.one()), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(
          v -> intake.set(v.in(Volts) / RobotController.getBatteryVoltage()),
          log -> log.motor("intake")
              .voltage(Volts.of(intake.get() * RobotController.getBatteryVoltage()))
              .angularPosition(Rotations.of(intake.getEncoder().getPosition()))
              .angularVelocity(Rotations.per(Minute).of(intake.getEncoder().getVelocity())),
          this));
}
