"""A drivetrain with one motor on each side: its tests, its gains and its feedforward."""

from collections.abc import Callable

from commands2 import Command, Subsystem

# TODO: 1. Import SysIdRoutine from commands2.sysid, and your feedforward from wpimath.controller.
from wpilib import Encoder, PWMSparkMax
from wpilib.sysid import SysIdRoutineLog

METERS_PER_PULSE = 0.000156  # wheel circumference over the encoder's pulses per turn


class CharacterizationConstants:
    """What SysId found out. Measured with a fresh battery; again when the drivetrain changes."""

    # TODO: 6. One constant for each gain that your fit shows, kP too. Next to each, a
    #       comment with its unit. Next to kP, also write how far you trust this number.


class ExampleSubsystem(Subsystem):
    """Two motors, two encoders that count meters, and a routine to test them with."""

    def __init__(self) -> None:
        super().__init__()
        self.left = PWMSparkMax(0)
        self.right = PWMSparkMax(1)
        self.right.setInverted(True)  # plus is forward on both sides
        self.left_encoder = Encoder(0, 1)
        self.right_encoder = Encoder(2, 3, reverseDirection=True)
        self.left_encoder.setDistancePerPulse(METERS_PER_PULSE)
        self.right_encoder.setDistancePerPulse(METERS_PER_PULSE)
        # TODO: 2. Make self.routine, a SysIdRoutine. Its Config says 0.5 V/s, 3.5 V and
        #       10 s; its Mechanism knows the two methods below, drive and record, and self.
        # TODO: 7. self.feedforward, made from your constants. It takes velocities in m/s.

    def drive(self, voltage: float) -> None:
        """Called in every loop of a test with the voltage the test wants [V]."""
        # TODO: 3. Send this voltage to both motors.

    def record(self, log: SysIdRoutineLog) -> None:
        """Called right after drive: write down what the motors did."""
        # TODO: 4. For each motor: its name, the voltage it got, its position [m] and its
        #       velocity [m/s]. The motor knows getVoltage(), the encoder getDistance(), getRate().

    # TODO: 5. Give other classes the four tests as commands: a method that makes the
    #       quasistatic test of a direction, and one that makes the dynamic test.

    def drive_straight(self, output: Callable[[], float]) -> Command:
        """Make the command that drives straight as a stick says."""

        def send() -> None:
            self.left.set(output())
            self.right.set(output())

        return self.run(send)
