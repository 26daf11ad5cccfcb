package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

public class HalfFile extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Vol