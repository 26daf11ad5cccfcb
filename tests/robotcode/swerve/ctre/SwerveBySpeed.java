package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.controls.VelocityVoltage;
import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** A mistake: the modules follow a speed, so that their controllers choose the voltage. */
public class SwerveBySpeed extends SubsystemBase {
  private final TalonFX m_left = new TalonFX(1);
  private final TalonFX m_right = new TalonFX(2);
  private final VelocityVoltage m_speed = new VelocityVoltage(0);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(null, Volts.of(4), null),
      new SysIdRoutine.Mechanism(
          volts -> {
            m_left.setControl(m_speed.withVelocity(volts.in(Volts)));
            m_right.setControl(m_speed.withVelocity(volts.in(Volts)));
          },
          null,
          this));
}
