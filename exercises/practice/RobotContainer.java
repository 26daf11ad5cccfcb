package frc.robot;

import edu.wpi.first.wpilibj2.command.button.CommandXboxController;
import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
import frc.robot.subsystems.ExampleSubsystem;
// TODO: 1. Import what your guard needs.

/** The robot's parts, and which button does what. */
public class RobotContainer {
  private final ExampleSubsystem m_subsystem = new ExampleSubsystem();
  private final CommandXboxController m_driverController = new CommandXboxController(0);

  public RobotContainer() {
    m_subsystem.setDefaultCommand(m_subsystem.driveStraight(() -> -m_driverController.getLeftY()));
    configureBindings();
  }

  private void configureBindings() {
    // TODO: 2. Bind the four tests to four buttons, so that each runs while its button is
    //       held, and never by accident in a match. Next to each, a comment: which test is it,
    //       and which property of the mechanism does it measure?
  }
}
