from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import Talon


class Windows(Subsystem):
	def __init__(self):
		self.motor = Talon(0)
		self.routine = SysIdRoutine(
			SysIdRoutine.Config(0.5, 3.5, 10),
			SysIdRoutine.Mechanism(self.motor.setVoltage, lambda log: None, self),
		)
