package frc.robot.subsystems;

import static edu.wpi.first.units.Units.Meters;
import static edu.wpi.first.units.Units.MetersPerSecond;
import static edu.wpi.first.units.Units.Second;
import static edu.wpi.first.units.Units.Seconds;
import static edu.wpi.first.units.Units.Volts;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;

/** A drivetrain with one motor on each side, ready to be characterized. */
public class ExampleSubsystem extends SubsystemBase {
  private static final double METERS_PER_ROTATION = 0.0472; // of the motor: wheel and gears

  private final TalonFX m_left = new TalonFX(1);
  private final TalonFX m_right = new TalonFX(2); // inverted in its settings: plus is forward

  // TODO: 1. The field of type SysIdRoutine. Its Config says 0.5 V/s, 3.5 V and 10 s; its
  //       Mechanism knows the two methods below, drive and record, and this subsystem.

  /** Called in every loop of a test with the voltage the test wants. */
  private void drive(Voltage voltage) {
    // TODO: 2. Send this voltage to both motors.
  }

  /** Called right after drive: write down what the motors did. */
  private void record(SysIdRoutineLog log) {
    // TODO: 3. For each motor: its name, the voltage it got, its position and its velocity.
  }

  private double getMeters(TalonFX motor) {
    return motor.getPosition().getValueAsDouble() * METERS_PER_ROTATION;
  }

  private double getMetersPerSecond(TalonFX motor) {
    return motor.getVelocity().getValueAsDouble() * METERS_PER_ROTATION;
  }
}
