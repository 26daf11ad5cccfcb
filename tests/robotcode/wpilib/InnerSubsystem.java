package frc.robot;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj.TimedRobot;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** The whole robot in one file, the subsystem a class inside it. */
public class InnerSubsystem extends TimedRobot {
  private final TalonFX m_outside = new TalonFX(1);

  private static class Kicker extends SubsystemBase {
    private final TalonFX m_leg = new TalonFX(2);
    private final SysIdRoutine m_sysId = new SysIdRoutine(
        new SysIdRoutine.Config(Volts.of(2).per(Second), Volts.of(6), Seconds.of(3)),
        new SysIdRoutine.Mechanism(v -> m_leg.setVoltage(v.in(Volts)), null, Kicker.this));
  }

  private final Kicker m_kicker = new Kicker();
}
