package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.controls.DutyCycleOut;
import com.ctre.phoenix6.controls.PositionVoltage;
import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** A share of the battery, a constant, a position, and nothing at all. */
public class Percent extends SubsystemBase {
  private final TalonFX share = new TalonFX(1);
  private final TalonFX fixed = new TalonFX(2);
  private final TalonFX held = new TalonFX(3);
  private final TalonFX idle = new TalonFX(4);

  private final SysIdRoutine routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5), Volts.of(3.5), Milliseconds.of(10)),
      new SysIdRoutine.Mechanism(
          volts -> {
            share.setControl(new DutyCycleOut(volts.in(Volts) / 12.0));
            fixed.setVoltage(6);
            held.setControl(new PositionVoltage(volts.in(Volts)));
          },
          null,
          null));
}
