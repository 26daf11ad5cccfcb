import static edu.wpi.first.units.Units.*;

public class TwoRoutines extends SubsystemBase {
  private final TalonFX m_steer = new TalonFX(1);
  private final TalonFX m_drive = new TalonFX(2);
  private final SysIdRoutine m_unfinished = new SysIdRoutine(new SysIdRoutine.Config(), null);
  private final SysIdRoutine m_steerRoutine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(2).per(Second), Volts.of(7), Seconds.of(4)),
      new SysIdRoutine.Mechanism(v -> m_steer.setVoltage(v.in(Volts)), null, this, "steer"));
  private final SysIdRoutine m_driveRoutine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(1).per(Second), Volts.of(2), Seconds.of(9)),
      new SysIdRoutine.Mechanism(v -> m_drive.setVoltage(v.in(Volts)), null, this, "drive"));
}
