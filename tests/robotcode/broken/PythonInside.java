from commands2 import Subsystem

class PythonInside(Subsystem):
    def __init__(self):
        self.motor = None
