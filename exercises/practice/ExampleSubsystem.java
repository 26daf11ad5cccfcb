package frc.robot.subsystems;

import static edu.wpi.first.units.Units.Meters;
import static edu.wpi.first.units.Units.MetersPerSecond;
import static edu.wpi.first.units.Units.Second;
import static edu.wpi.first.units.Units.Seconds;
import static edu.wpi.first.units.Units.Volts;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.math.controller.SimpleMotorFeedforward;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.Command;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import java.util.function.DoubleSupplier;

/** A drivetrain with one motor on each side: its tests, its gains and its feedforward. */
public class ExampleSubsystem extends SubsystemBase {
  /** What SysId found out. Measured with a fresh battery; measure again when the drivetrain changes. */
  public static final class CharacterizationConstants {
    // TODO: 5. One constant for each gain that your fit shows, kP too. Next to each, a
    //       comment with its unit. Next to kP, also write how far you trust this number.
  }

  private static final double METERS_PER_ROTATION = 0.0472; // of the motor: wheel and gears

  private final TalonFX m_left = new TalonFX(1);
  private final TalonFX m_right = new TalonFX(2); // inverted in its settings: plus is forward

  // TODO: 1. The field of type SysIdRoutine. Its Config says 0.5 V/s, 3.5 V and 10 s; its
  //       Mechanism knows the two methods below, drive and record, and this subsystem.

  // TODO: 6. The feedforward, made from your constants. It takes velocities in m/s.

  /** Called in every loop of a test with the voltage the test wants. */
  private void drive(Voltage voltage) {
    // TODO: 2. Send this voltage to both motors.
  }

  /** Called right after drive: write down what the motors did. */
  private void record(SysIdRoutineLog log) {
    // TODO: 3. For each motor: its name, the voltage it got, its position and its velocity.
  }

  // TODO: 4. Give other classes the four tests as commands: a public method that makes
  //       the quasistatic test of a direction, and one that makes the dynamic test.

  /** Makes the command that drives straight as a stick says. */
  public Command driveStraight(DoubleSupplier output) {
    return run(
        () -> {
          m_left.set(output.getAsDouble());
          m_right.set(output.getAsDouble());
        });
  }

  private double getMeters(TalonFX motor) {
    return motor.getPosition().getValueAsDouble() * METERS_PER_ROTATION;
  }

  private double getMetersPerSecond(TalonFX motor) {
    return motor.getVelocity().getValueAsDouble() * METERS_PER_ROTATION;
  }
}
