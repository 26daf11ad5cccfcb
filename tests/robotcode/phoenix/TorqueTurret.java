package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.SignalLogger;
import com.ctre.phoenix6.controls.TorqueCurrentFOC;
import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Ampere in the dress of volts: fine for some, but no voltage reaches the motor. */
public class TorqueTurret extends SubsystemBase {
  private final TalonFX m_turret = new TalonFX(41);
  private final TorqueCurrentFOC m_current = new TorqueCurrentFOC(0);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(
          Volts.of(3).per(Second),
          Volts.of(25),
          null,
          state -> SignalLogger.writeString("state", state.toString())),
      new SysIdRoutine.Mechanism(
          amps -> m_turret.setControl(m_current.withOutput(amps.in(Volts))), null, this));
}
