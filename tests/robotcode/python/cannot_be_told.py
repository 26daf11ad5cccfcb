import os

import wpilib
from commands2 import Subsystem
from commands2.sysid import SysIdRoutine


class CannotBeTold(Subsystem):
    def __init__(self):
        self.motor = wpilib.PWMSparkMax(0)
        step = float(os.environ.get("STEP", "3.5"))
        ramp = 0.5
        if wpilib.RobotBase.isSimulation():
            ramp = 1.0
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(ramp, step, wpilib.Preferences.getDouble("timeout", 10)),
            SysIdRoutine.Mechanism(self.drive, self.log, self),
        )

    def drive(self, volts):
        self.motor.setVoltage(volts * wpilib.Preferences.getDouble("share", 1))

    def log(self, log):
        for name in os.listdir():
            log.motor(f"motor-{name}").voltage(self.motor.getVoltage())
