import constants
from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from constants import ElevatorConstants
from rev import SparkBase, SparkMax, SparkMaxConfig

from .motors import make_motor


class Elevator(Subsystem):
    def __init__(self):
        self.leader = SparkMax(1, SparkMax.MotorType.kBrushless)
        self.follower = SparkMax(2, SparkMax.MotorType.kBrushless)
        self.extra = make_motor(3)
        self.encoder = self.leader.getEncoder()
        follow = SparkMaxConfig().follow(self.leader, True)
        self.follower.configure(
            follow, SparkBase.ResetMode.kResetSafeParameters, SparkBase.PersistMode.kNoPersistParameters
        )
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(
                rampRate=constants.kRamp,
                stepVoltage=ElevatorConstants.kStep,
                timeout=constants.ElevatorConstants.kTimeout,
            ),
            SysIdRoutine.Mechanism(
                lambda volts: self.leader.setVoltage(volts),
                lambda log: log.motor("elevator")
                .voltage(self.leader.getAppliedOutput() * self.leader.getBusVoltage())
                .position(self.encoder.getPosition())
                .velocity(self.encoder.getVelocity()),
                self,
            ),
        )
