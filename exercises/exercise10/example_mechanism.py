"""A mechanism that was characterized, and that shall follow a velocity."""

from commands2 import Subsystem


class CharacterizationConstants:
    """What SysId found out. Measured with a fresh battery; again when the mechanism changes."""

    # TODO: 1. One constant for each gain that the analyzer shows, kP among them. Beside each, a
    #       comment with its unit. Beside kP, also say how far this number can be trusted.


class ExampleMechanism(Subsystem):
    """Follows a velocity."""

    def __init__(self) -> None:
        super().__init__()
        # TODO: 2. self.feedforward, made of these constants: wpimath.controller has three classes,
        #       of which one fits your mechanism. Its velocities come in the unit that given.toml
        #       tells under [robot].
