from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Talon


class Stairs(Subsystem):
    def __init__(self):
        self.motor = Talon(0)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(0.5, 3.5, 10),
            SysIdRoutine.Mechanism(self.drive, lambda log: None, self),
        )

    def drive(self, volts):
        if True:
            if True:
                if True:
                    if True:
                        if True:
                            if True:
                                if True:
                                    if True:
                                        if True:
                                            if True:
                                                if True:
                                                    if True:
                                                        if True:
                                                            if True:
                                                                if True:
                                                                    if True:
                                                                        if True:
                                                                            if True:
                                                                                if True:
                                                                                    self.motor.setVoltage(volts)
