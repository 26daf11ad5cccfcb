import wpilib
from commands2 import Subsystem, TimedCommandRobot
from commands2.sysid import SysIdRoutine


class Wheels(Subsystem):
    def __init__(self):
        self.motor = wpilib.PWMSparkMax(0)

    def drive(self, volts):
        self.motor.setVoltage(volts)


class Robot(TimedCommandRobot):
    """The routine stands in the robot, the motor in the subsystem."""

    def robotInit(self):
        self.wheels = Wheels()
        config = SysIdRoutine.Config(2, 5, 10.0)
        mechanism = SysIdRoutine.Mechanism(self.wheels.drive, lambda log: None, self.wheels, "w")
        self.routine = SysIdRoutine(config, mechanism)


if __name__ == "__main__":
    wpilib.run(Robot)
