from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from phoenix6 import SignalLogger, swerve


class GentleTranslation(Subsystem, swerve.SwerveDrivetrain):
    """A step below the slip, and a ramp that fits into the gym."""

    RAMP = 0.5
    STEP = 1.8

    def __init__(self) -> None:
        super().__init__()
        self.straight = swerve.requests.SysIdSwerveTranslation()
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(self.RAMP, self.STEP, 8.0),
            SysIdRoutine.Mechanism(
                lambda volts: self.set_control(self.straight.with_volts(volts)),
                lambda log: None,
                self,
                "drive",
            ),
        )
