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
// TODO: 1. Import what your guard needs.

/** The robot's parts, and which button does what. */
public class RobotContainer {
  private final ExampleSubsystem m_subsystem = new ExampleSubsystem();
  private final CommandXboxController m_driverController = new CommandXboxController(0);

  public RobotContainer() {
    m_subsystem.setDefaultCommand(m_subsystem.turn(() -> -m_driverController.getLeftY()));
    configureBindings();
  }

  private void configureBindings() {
    // TODO: 3. Bind the four tests to four buttons, so that each runs while its button is
    //       held, and never by accident in a match. Next to each, a comment: which test is it,
    //       and which property of the mechanism does it measure?
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

  // TODO: 2. Give other classes the four tests as commands: a public method that makes
  //       the quasistatic test of a direction, and one that makes the dynamic test.

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
