public class UnclosedComment extends SubsystemBase {
  private final TalonFX m_motor = new TalonFX(1);
  /* The routine comes here.
  private final SysIdRoutine m_routine = new SysIdRoutine(null, null);
}
