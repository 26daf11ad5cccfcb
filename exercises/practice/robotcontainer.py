"""The robot's parts, and which button does what."""

from commands2.button import CommandXboxController
from example_subsystem import ExampleSubsystem

# TODO: 1. Import SysIdRoutine from commands2.sysid, and what your guard needs from wpilib.


class RobotContainer:
    """Everything there is on the robot."""

    def __init__(self) -> None:
        self.subsystem = ExampleSubsystem()
        self.driver = CommandXboxController(0)
        self.subsystem.setDefaultCommand(
            self.subsystem.drive_straight(lambda: -self.driver.getLeftY())
        )
        self.configure_bindings()

    def configure_bindings(self) -> None:
        """Say which button does what."""
        # TODO: 2. Bind the four tests to four buttons, so that each runs while its button is
        #       held, and never by accident in a match. Next to each, a comment: which test is it,
        #       and which property of the mechanism does it measure?
