package org.example;

import static org.wpilib.units.Units.*;

import org.wpilib.command2.SubsystemBase;
import org.wpilib.command2.sysid.SysIdRoutine;

public class Season2027 extends SubsystemBase {
  private final TalonFXS motor = new TalonFXS(4);
  private final VoltageOut request = new VoltageOut(0);
  private final StatusSignal<Voltage> motorVoltage = motor.getMotorVoltage();

  private final SysIdRoutine routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).div(Seconds.of(1)), Volts.of(3.5), Second.of(10)),
      new SysIdRoutine.Mechanism(
          volts -> {
            request.Output = volts.in(Volts);
            motor.setControl(request);
          },
          log ->
              log.motor("hood")
                  .voltage(motorVoltage.refresh().getValue())
                  .angularPosition(Degrees.of(motor.getPosition().getValueAsDouble() * 360))
                  .angularVelocity(DegreesPerSecond.of(motor.getVelocity().getValueAsDouble() * 360)),
          this));

  public Command forward() {
    return routine.dynamic(SysIdRoutine.Direction.FORWARD);
  }
}
