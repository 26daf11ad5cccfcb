package frc.robot.subsystems.swervedrive;

import static edu.wpi.first.units.Units.*;

import com.revrobotics.spark.SparkLowLevel.MotorType;
import com.revrobotics.spark.SparkMax;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** A mistake: the log has the voltage that was asked for. */
public class CommandedLog extends SubsystemBase {
  private final SparkMax drive = new SparkMax(1, MotorType.kBrushless);
  private Voltage asked = Volts.of(0);

  private final SysIdRoutine routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(
          volts -> {
            asked = volts;
            drive.setVoltage(volts);
          },
          log -> log.motor("drive")
              .voltage(asked)
              .linearPosition(Meters.of(drive.getEncoder().getPosition()))
              .linearVelocity(MetersPerSecond.of(drive.getEncoder().getVelocity())),
          this));
}
