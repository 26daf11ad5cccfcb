package frc.robot.subsystems.drive;

import static edu.wpi.first.units.Units.*;

import com.revrobotics.spark.SparkFlex;
import com.revrobotics.spark.SparkLowLevel.MotorType;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** A mistake: open loop is taken for a share of the battery. */
public class DutyDrive extends SubsystemBase {
  private final SparkFlex front = new SparkFlex(1, MotorType.kBrushless);
  private final SparkFlex back = new SparkFlex(2, MotorType.kBrushless);

  private final SysIdRoutine sysId =
      new SysIdRoutine(
          new SysIdRoutine.Config(null, Volts.of(4), null),
          new SysIdRoutine.Mechanism(
              (voltage) -> {
                front.set(voltage.in(Volts) / 12.0);
                back.set(voltage.in(Volts) / 12.0);
              },
              null,
              this));
}
