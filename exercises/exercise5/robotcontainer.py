"""The robot's parts, and which button does what."""

from collections.abc import Callable

import wpilib
from commands2 import Command, Subsystem
from commands2.button import CommandXboxController
from commands2.sysid import SysIdRoutine
from wpilib.sysid import SysIdRoutineLog


class ExampleSubsystem(Subsystem):
    """One motor, and a routine to characterize it with."""

    def __init__(self) -> None:
        super().__init__()
        self.motor = wpilib.PWMSparkMax(0)
        self.encoder = wpilib.Encoder(0, 1)
        self.encoder.setDistancePerPulse(0.000156)  # [m]
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(rampRate=0.5, stepVoltage=3.5, timeout=10.0),
            SysIdRoutine.Mechanism(self.drive, self.record, self),
        )

    # TODO: 1. Give other classes the four tests as commands: a method that makes the
    #       quasistatic test of a direction, and one that makes the dynamic test.

    def turn(self, output: Callable[[], float]) -> Command:
        """Make the command that turns the motor as a stick says."""
        return self.run(lambda: self.motor.set(output()))

    def drive(self, voltage: float) -> None:
        """Send the voltage of a test to the motor [V]."""
        self.motor.setVoltage(voltage)

    def record(self, log: SysIdRoutineLog) -> None:
        """Write down what the motor did."""
        motor = log.motor("motor").voltage(self.motor.getVoltage())
        motor.position(self.encoder.getDistance()).velocity(self.encoder.getRate())


class RobotContainer:
    """Everything there is on the robot."""

    def __init__(self) -> None:
        self.subsystem = ExampleSubsystem()
        self.driver = CommandXboxController(0)
        self.subsystem.setDefaultCommand(self.subsystem.turn(lambda: -self.driver.getLeftY()))
        self.configure_bindings()

    def configure_bindings(self) -> None:
        """Say which button does what."""
        # TODO: 2. Bind the four tests to four buttons, so that each runs while its button is
        #       held, and never by accident in a match. Next to each, a comment: which test is it,
        #       and which property of the mechanism does it measure?
