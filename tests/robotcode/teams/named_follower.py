from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import Enum, auto

from commands2 import Command, SubsystemBase, cmd
from commands2.sysid import SysIdRoutine
from ntcore import NetworkTableInstance
from rev import (
    ClosedLoopConfig,
    PersistMode,
    ResetMode,
    SparkBaseConfig,
    SparkMax,
    SparkMaxConfig,
)
from wpilib import DataLogManager, RobotBase, SmartDashboard
from wpilib.sysid import SysIdRoutineLog


class Height(Enum):
    STOW = 0.0
    L2 = 0.4
    L3 = 0.9


@dataclass(frozen=True)
class ElevatorConfig:
    leader: int = 11
    follower: int = 12
    drum_diameter: float = 0.0445
    reduction: float = 9.0
    stages: int = 2

    @property
    def meters_per_rotation(self) -> float:
        return math.pi * self.drum_diameter * self.stages / self.reduction


class Elevator(SubsystemBase):
    def __init__(self, config: ElevatorConfig = ElevatorConfig()) -> None:
        super().__init__()
        self.setName("Elevator")
        self.config = config
        self.leader = SparkMax(config.leader, SparkMax.MotorType.kBrushless)
        self.follower = SparkMax(config.follower, SparkMax.MotorType.kBrushless)
        base = SparkMaxConfig()
        base.setIdleMode(SparkBaseConfig.IdleMode.kBrake).smartCurrentLimit(50)
        base.encoder.positionConversionFactor(config.meters_per_rotation)
        base.encoder.velocityConversionFactor(config.meters_per_rotation / 60)
        self.leader.configure(base, ResetMode.kResetSafeParameters, PersistMode.kPersistParameters)
        follow = SparkMaxConfig().apply(base).follow(config.leader, invert=True)
        self.follower.configure(
            follow, ResetMode.kResetSafeParameters, PersistMode.kPersistParameters
        )
        self.encoder = self.leader.getEncoder()
        table = NetworkTableInstance.getDefault().getTable("elevator")
        self.height_pub = table.getDoubleTopic("height").publish()
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10),
            SysIdRoutine.Mechanism(self.leader.setVoltage, self.log_sysid, self),
        )

    def periodic(self) -> None:
        self.height_pub.set(self.encoder.getPosition())
        SmartDashboard.putNumber("elevator/height", self.encoder.getPosition())

    def log_sysid(self, log: SysIdRoutineLog) -> None:
        motor = log.motor("elevator")
        motor.voltage(self.leader.getAppliedOutput() * self.leader.getBusVoltage())
        motor.position(self.encoder.getPosition())
        motor.velocity(self.encoder.getVelocity())

    def run_all(self) -> Command:
        tests = [
            make(way)
            for make in (self.routine.quasistatic, self.routine.dynamic)
            for way in (SysIdRoutine.Direction.kForward, SysIdRoutine.Direction.kReverse)
        ]
        return cmd.sequence(*(test.andThen(cmd.waitSeconds(0.5)) for test in tests))
