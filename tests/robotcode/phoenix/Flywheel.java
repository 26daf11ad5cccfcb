package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.BaseStatusSignal;
import com.ctre.phoenix6.StatusSignal;
import com.ctre.phoenix6.controls.Follower;
import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.TalonFX;
import com.ctre.phoenix6.signals.MotorAlignmentValue;
import edu.wpi.first.units.measure.*;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

public class Flywheel extends SubsystemBase {
  private final TalonFX leader = new TalonFX(21, "canivore");
  private final TalonFX follower = new TalonFX(22, "canivore");
  private final VoltageOut request = new VoltageOut(0).withEnableFOC(true);
  private final StatusSignal<Angle> position = leader.getPosition();
  private final StatusSignal<AngularVelocity> velocity = leader.getVelocity();
  private final StatusSignal<Voltage> voltage = leader.getMotorVoltage();

  private final SysIdRoutine routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(
              Volts.of(0.25).per(Second), Volts.of(6), Seconds.of(20)),
          new SysIdRoutine.Mechanism(
              volts -> leader.setControl(request.withOutput(volts)),
              log -> {
                BaseStatusSignal.refreshAll(position, velocity, voltage);
                log.motor("flywheel")
                    .voltage(voltage.getValue())
                    .angularPosition(position.getValue())
                    .angularVelocity(velocity.getValue());
              },
              this));

  public Flywheel() {
    follower.setControl(new Follower(leader.getDeviceID(), MotorAlignmentValue.Opposed));
  }
}
