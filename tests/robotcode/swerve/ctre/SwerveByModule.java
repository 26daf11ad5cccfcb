package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.controls.PositionVoltage;
import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Phoenix without the generator: the steer motors are held, the drive motors get the voltage. */
public class SwerveByModule extends SubsystemBase {
  private final TalonFX frontLeft = new TalonFX(1);
  private final TalonFX frontRight = new TalonFX(2);
  private final TalonFX backLeft = new TalonFX(3);
  private final TalonFX backRight = new TalonFX(4);
  private final VoltageOut request = new VoltageOut(0);

  private final SysIdRoutine routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(2), Seconds.of(10)),
      new SysIdRoutine.Mechanism(this::driveStraight, log -> {
        log.motor("front-left")
            .voltage(frontLeft.getMotorVoltage().getValue())
            .angularPosition(frontLeft.getPosition().getValue())
            .angularVelocity(frontLeft.getVelocity().getValue());
        log.motor("back-right")
            .voltage(backRight.getMotorVoltage().getValue())
            .angularPosition(backRight.getPosition().getValue())
            .angularVelocity(backRight.getVelocity().getValue());
      }, this));

  private void driveStraight(edu.wpi.first.units.measure.Voltage volts) {
    frontLeft.setControl(request.withOutput(volts));
    frontRight.setControl(request.withOutput(volts));
    backLeft.setControl(request.withOutput(volts));
    backRight.setControl(request.withOutput(volts));
  }
}
