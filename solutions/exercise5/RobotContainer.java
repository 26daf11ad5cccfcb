package frc.robot;

import static edu.wpi.first.units.Units.Meters;
import static edu.wpi.first.units.Units.MetersPerSecond;
import static edu.wpi.first.units.Units.Second;
import static edu.wpi.first.units.Units.Seconds;
import static edu.wpi.first.units.Units.Volts;

import com.ctre.phoenix6.hardware.TalonFX;
import edu.wpi.first.units.measure.Voltage;
import edu.wpi.first.wpilibj.sysid.SysIdRoutineLog;
import edu.wpi.first.wpilibj2.command.Command;
import edu.wpi.first.wpilibj2.command.SubsystemBase;
import edu.wpi.first.wpilibj2.command.button.CommandXboxController;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import java.util.function.DoubleSupplier;
// --- answer: 1. Import what your guard needs.
import edu.wpi.first.wpilibj2.command.button.RobotModeTriggers;
import edu.wpi.first.wpilibj2.command.button.Trigger;
// --- end

/** The robot's parts, and which button does what. */
public class RobotContainer {
  private final ExampleSubsystem m_subsystem = new ExampleSubsystem();
  private final CommandXboxController m_driverController = new CommandXboxController(0);

  public RobotContainer() {
    m_subsystem.setDefaultCommand(m_subsystem.turn(() -> -m_driverController.getLeftY()));
    configureBindings();
  }

  private void configureBindings() {
    // --- answer: 3. Bind the four tests to four buttons, so that each runs while its button is
    // ---   held, and never by accident in a match. Next to each, a comment: which test is it,
    // ---   and which property of the mechanism does it measure?
    Trigger testing = RobotModeTriggers.test();
    // Quasistatic, forward: a slow ramp, which measures kS and kV.
    m_driverController.a().and(testing).whileTrue(
        m_subsystem.sysIdQuasistatic(SysIdRoutine.Direction.kForward));
    // Quasistatic, reverse: kS and kV once more, from the other side.
    m_driverController.b().and(testing).whileTrue(
        m_subsystem.sysIdQuasistatic(SysIdRoutine.Direction.kReverse));
    // Dynamic, forward: a step, which measures kA.
    m_driverController.x().and(testing).whileTrue(
        m_subsystem.sysIdDynamic(SysIdRoutine.Direction.kForward));
    // Dynamic, reverse: kA once more, from the other side.
    m_driverController.y().and(testing).whileTrue(
        m_subsystem.sysIdDynamic(SysIdRoutine.Direction.kReverse));
    // --- end
  }
}

/** One motor, and a routine to characterize it with. */
class ExampleSubsystem extends SubsystemBase {
  private static final double METERS_PER_ROTATION = 0.0472; // of the motor: wheel and gears

  private final TalonFX m_motor = new TalonFX(1);
  private final SysIdRoutine m_routine =
      new SysIdRoutine(
          new SysIdRoutine.Config(Volts.of(0.5).per(Second), Volts.of(3.5), Seconds.of(10)),
          new SysIdRoutine.Mechanism(this::drive, this::record, this));

  // --- answer: 2. Give other classes the four tests as commands: a public method that makes
  // ---   the quasistatic test of a direction, and one that makes the dynamic test.
  public Command sysIdQuasistatic(SysIdRoutine.Direction direction) {
    return m_routine.quasistatic(direction);
  }

  public Command sysIdDynamic(SysIdRoutine.Direction direction) {
    return m_routine.dynamic(direction);
  }
  // --- end

  /** Makes the command that turns the motor as a stick says. */
  public Command turn(DoubleSupplier output) {
    return run(() -> m_motor.set(output.getAsDouble()));
  }

  private void drive(Voltage voltage) {
    m_motor.setVoltage(voltage.in(Volts));
  }

  private void record(SysIdRoutineLog log) {
    double rotations = m_motor.getPosition().getValueAsDouble();
    double rotationsPerSecond = m_motor.getVelocity().getValueAsDouble();
    log.motor("motor")
        .voltage(Volts.of(m_motor.getMotorVoltage().getValueAsDouble()))
        .linearPosition(Meters.of(rotations * METERS_PER_ROTATION))
        .linearVelocity(MetersPerSecond.of(rotationsPerSecond * METERS_PER_ROTATION));
  }
}
