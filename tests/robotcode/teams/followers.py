import phoenix6
import rev
from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from phoenix6.controls import Follower


class Followers(Subsystem):
    """One leads, two follow, by settings and by request."""

    def __init__(self):
        self.leader = rev.SparkMax(1, rev.SparkMax.MotorType.kBrushless)
        self.second = rev.SparkMax(2, rev.SparkMax.MotorType.kBrushless)
        config = rev.SparkMaxConfig()
        config.follow(self.leader, True)
        self.second.configure(
            config, rev.ResetMode.kResetSafeParameters, rev.PersistMode.kPersistParameters
        )
        self.boss = phoenix6.hardware.TalonFX(3)
        self.third = phoenix6.hardware.TalonFX(4)
        self.third.set_control(Follower(3, False))
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10),
            SysIdRoutine.Mechanism(self.drive, self.log, self),
        )

    def drive(self, volts):
        self.leader.setVoltage(volts)
        request = phoenix6.controls.VoltageOut(volts)
        self.boss.set_control(request)

    def log(self, log):
        applied = self.leader.getAppliedOutput() * self.leader.getBusVoltage()
        turns = self.leader.getEncoder().getPosition()
        log.motor("spark").voltage(applied).angularPosition(turns)
        log.motor("talon").voltage(self.boss.get_motor_voltage().value_as_double)
