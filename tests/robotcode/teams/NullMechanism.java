package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.wpilibj.motorcontrol.PWMSparkMax;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** No callback does anything: the drive callback is null, the log callback too. */
public class NullMechanism extends SubsystemBase {
  private final PWMSparkMax m_motor = new PWMSparkMax(0);
  private final SysIdRoutine m_routine =
      new SysIdRoutine(new SysIdRoutine.Config(), new SysIdRoutine.Mechanism(null, null, this));
}
