"""A mechanism that was characterized, and that should follow a velocity."""

from commands2 import Subsystem

# TODO: 1. Import your feedforward. wpimath.controller has one for each kind of mechanism.


class CharacterizationConstants:
    """What SysId found out. Measured with a fresh battery; again when the mechanism changes."""

    # TODO: 2. One constant for each gain that the analyzer shows, kP too. Next to each, a
    #       comment with its unit. Next to kP, also write how far you trust this number.


class ExampleMechanism(Subsystem):
    """Follows a velocity."""

    def __init__(self) -> None:
        super().__init__()
        # TODO: 3. self.feedforward, made of these constants. Its velocities come in the unit that
        #       given.toml names under [robot]. Or put the gains into the motor controller:
        #       Slot0Configs() (phoenix6.configs) or closedLoop.feedForward of a SparkMaxConfig.
