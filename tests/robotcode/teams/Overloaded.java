package frc.robot.subsystems;

import static edu.wpi.first.units.Units.*;

import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.motorcontrol.PWMSparkMax;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** Two methods of one name, told apart by how much they take; an early return. */
public class Overloaded extends SubsystemBase {
  private final PWMSparkMax m_left = new PWMSparkMax(0);
  private final PWMSparkMax m_right = new PWMSparkMax(1);
  private boolean m_broken;

  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
      new SysIdRoutine.Mechanism(volts -> drive(volts.in(Volts)), null, this));

  private void drive(double both) {
    if (m_broken) {
      return;
    }
    drive(both, both * -1.0);
  }

  private void drive(double left, double right) {
    m_left.setVoltage(left);
    m_right.setVoltage(right);
  }
}
