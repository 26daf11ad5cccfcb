package org.example.robot;

import static org.wpilib.units.Units.Meters;
import static org.wpilib.units.Units.MetersPerSecond;
import static org.wpilib.units.Units.Second;
import static org.wpilib.units.Units.Seconds;
import static org.wpilib.units.Units.Volts;

import org.wpilib.command2.Command;
import org.wpilib.command2.SubsystemBase;
import org.wpilib.command2.sysid.SysIdRoutine;
import org.wpilib.hardware.motor.PWMSparkMax;
import org.wpilib.hardware.rotation.Encoder;
import org.wpilib.system.RobotController;

public class Season2027Drive extends SubsystemBase {
  private final PWMSparkMax left = new PWMSparkMax(0);
  private final PWMSparkMax right = new PWMSparkMax(1);
  private final Encoder leftEncoder = new Encoder(0, 1);

  private final SysIdRoutine routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.Mechanism(
              volts -> {
                left.setVoltage(volts);
                right.setVoltage(volts);
              },
              log ->
                  log.motor("left")
                      .voltage(Volts.of(left.getDutyCycle() * RobotController.getBatteryVoltage()))
                      .linearPosition(Meters.of(leftEncoder.getDistance()))
                      .linearVelocity(MetersPerSecond.of(leftEncoder.getRate())),
              this));

  public Command forward() {
    return routine.dynamic(SysIdRoutine.Direction.FORWARD);
  }
}
