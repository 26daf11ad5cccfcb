package first.robot;

import static org.wpilib.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import org.wpilib.command3.Command;
import org.wpilib.command3.Mechanism;
import org.wpilib.command3.Trigger;
import org.wpilib.command3.button.CommandXboxController;
import org.wpilib.command3.button.RobotModeTriggers;
import org.wpilib.command3.sysid.SysIdRoutine;
import org.wpilib.command3.sysid.SysIdRoutine.Direction;

/** Buttons and mechanism in one file, the mechanism a class inside. */
public class WholeRobot {
  private final Arm m_arm = new Arm();
  private final CommandXboxController m_driver = new CommandXboxController(0);

  public WholeRobot() {
    Trigger testing = RobotModeTriggers.utility();
    m_driver.a().and(testing).whileTrue(m_arm.quasistatic(Direction.FORWARD));
    m_driver.b().and(testing).whileTrue(m_arm.quasistatic(Direction.REVERSE));
    m_arm.setDefaultCommand(m_arm.stop());
  }

  private static class Arm extends Mechanism {
    private final TalonFX m_joint = new TalonFX(5);
    private final SysIdRoutine m_routine =
        new SysIdRoutine(
            SysIdRoutine.Config.useDataLog(
                Volts.of(0.5).per(Second), Volts.of(1), Seconds.of(5)),
            new SysIdRoutine.SysIdMechanism(
                volts -> m_joint.setVoltage(volts.in(Volts)), null, this));

    Command quasistatic(Direction direction) {
      return m_routine.quasistatic(direction);
    }

    Command stop() {
      return run(
              coroutine -> {
                m_joint.setVoltage(0);
                coroutine.park();
              })
          .named("stop");
    }
  }
}
