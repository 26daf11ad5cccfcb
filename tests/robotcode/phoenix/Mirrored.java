package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import com.ctre.phoenix6.controls.VoltageOut;
import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Four motors, four ways to turn a voltage around or to change it. */
public class Mirrored extends SubsystemBase {
  private final TalonFX m_one = new TalonFX(1);
  private final TalonFX m_two = new TalonFX(2);
  private final TalonFX m_three = new TalonFX(3);
  private final TalonFX m_four = new TalonFX(4);

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(1).div(Seconds.of(2)), Volts.of(7).div(2), Seconds.of(10)),
      new SysIdRoutine.Mechanism(
          volts -> {
            m_one.setVoltage(-volts.in(Volts));
            m_two.setVoltage(volts.unaryMinus().in(Volts));
            m_three.setControl(new VoltageOut(volts.times(-1)));
            m_four.setVoltage(volts.times(0.5).in(Volts));
          },
          null,
          this));
}
