package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.revrobotics.spark.SparkBase.ControlType;
import com.revrobotics.spark.SparkMax;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** The voltage is handed to a velocity loop. */
public class SetpointVelocity extends SubsystemBase {
  private final SparkMax roller = new SparkMax(9, SparkMax.MotorType.kBrushless);

  private final SysIdRoutine routine = new SysIdRoutine(
      new SysIdRoutine.Config(null, null, Seconds.of(5)),
      new SysIdRoutine.Mechanism(
          v -> roller.getClosedLoopController().setSetpoint(v.in(Volts) * 400, ControlType.kVelocity),
          log -> {
            var motor = log.motor("roller");
            motor.voltage(Volts.of(roller.getBusVoltage()));
            motor.angularVelocity(RPM.of(roller.getEncoder().getVelocity()));
          },
          this));
}
