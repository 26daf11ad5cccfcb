package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.math.controller.ArmFeedforward;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** The voltage of the test, and gravity on top: no longer what the test asked for. */
public class FeedforwardInDrive extends SubsystemBase {
  private final TalonFX m_arm = new TalonFX(3);
  private final ArmFeedforward m_feedforward = new ArmFeedforward(0.1, 0.4, 1.2);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(
          volts -> m_arm.setVoltage(
              volts.in(Volts) + m_feedforward.calculate(m_arm.getPosition().getValueAsDouble(), 0)),
          null,
          this));
}
