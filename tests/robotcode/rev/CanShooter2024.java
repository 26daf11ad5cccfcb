package frc.robot.subsystems;

import static edu.wpi.first.units.MutableMeasure.mutable;
import static edu.wpi.first.units.Units.Rotations;
import static edu.wpi.first.units.Units.RotationsPerSecond;
import static edu.wpi.first.units.Units.Volts;

import com.revrobotics.CANSparkLowLevel.MotorType;
import com.revrobotics.CANSparkMax;
import edu.wpi.first.units.Angle;
import edu.wpi.first.units.Measure;
import edu.wpi.first.units.MutableMeasure;
import edu.wpi.first.units.Velocity;
import edu.wpi.first.units.Voltage;
import edu.wpi.first.wpilibj.RobotController;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** The season of 2024: CANSparkMax, Measure of Voltage, MutableMeasure. */
public class CanShooter2024 extends SubsystemBase {
  private final CANSparkMax m_wheel = new CANSparkMax(4, MotorType.kBrushless);

  private final MutableMeasure<Voltage> m_appliedVoltage = mutable(Volts.of(0));
  private final MutableMeasure<Angle> m_angle = mutable(Rotations.of(0));
  private final MutableMeasure<Velocity<Angle>> m_velocity = mutable(RotationsPerSecond.of(0));

  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(),
          new SysIdRoutine.Mechanism(
              (Measure<Voltage> volts) -> {
                m_wheel.setVoltage(volts.in(Volts));
              },
              log -> {
                log.motor("wheel")
                    .voltage(
                        m_appliedVoltage.mut_replace(
                            m_wheel.get() * RobotController.getBatteryVoltage(), Volts))
                    .angularPosition(
                        m_angle.mut_replace(m_wheel.getEncoder().getPosition(), Rotations))
                    .angularVelocity(
                        m_velocity.mut_replace(
                            m_wheel.getEncoder().getVelocity() / 60, RotationsPerSecond));
              },
              this));
}
