import wpilib
from commands2 import Subsystem
from commands2.sysid import SysIdRoutine


class Drive(Subsystem):
    def __init__(self):
        self.left = wpilib.PWMVictorSPX(0)
        self.right = wpilib.PWMVictorSPX(1)
        self.rollers = [wpilib.PWMVenom(n) for n in (2, 3)]
        self.group = wpilib.MotorControllerGroup(wpilib.Talon(4), wpilib.Talon(5))
        settings = {"rampRate": 0.5}
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(**settings),
            SysIdRoutine.Mechanism(self.drive, self.log, self),
        )

    def drive(self, volts):
        for motor in (self.left, self.right):
            motor.setVoltage(volts)
        [roller.setVoltage(volts) for roller in self.rollers]
        self.group.setVoltage(volts + 0.2)

    def log(self, log):
        for name, motor in (("left", self.left), ("right", self.right)):
            log.motor(name).voltage(motor.get() * wpilib.RobotController.getBatteryVoltage())
