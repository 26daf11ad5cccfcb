"""What all winches have in common."""

from commands2 import Subsystem
from wpilib import PWMSparkMax


class WinchBase(Subsystem):
    STEP = 3.5

    def __init__(self, channel):
        super().__init__()
        self.motor = PWMSparkMax(channel)

    def push(self, volts):
        self.motor.setVoltage(volts)

    def note(self, log):
        log.motor("winch").voltage(self.motor.getVoltage())
