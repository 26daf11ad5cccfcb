from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import PWMTalonFX, RobotController


class Shooter(Subsystem):
    def __init__(self):
        self.top = PWMTalonFX(0)
        self.bottom = PWMTalonFX(1)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(rampRate=0.5, stepVoltage=3.5, timeout=10.0),
            SysIdRoutine.Mechanism(self.drive, self.log, self),
        )

    def drive(self, volts):
        share = volts / RobotController.getBatteryVoltage()
        self.top.set(share)
        self.run_bottom(volts / 12)

    def run_bottom(self, power):
        self.bottom.setVoltage(power * 12)

    def log(self, log):
        pass
