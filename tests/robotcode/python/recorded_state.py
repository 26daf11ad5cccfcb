from commands2 import Subsystem, sysid
from phoenix6 import SignalLogger, controls, hardware
from wpilib.sysid import SysIdRoutineLog, State


class RecordedState(Subsystem):
    def __init__(self):
        super().__init__()
        self.__motor = hardware.TalonFX(3)
        self.__out = controls.VoltageOut(0)
        self.__config = sysid.SysIdRoutine.Config(recordState=self.write_state, stepVoltage=4)
        self.__mechanism = sysid.SysIdRoutine.Mechanism(self.apply, lambda _: None, self, "arm")
        self.__sysid = sysid.SysIdRoutine(self.__config, self.__mechanism)

    def apply(self, volts: float):
        self.__motor.set_control(self.__out.with_output(volts))

    def write_state(self, state: State):
        SignalLogger.write_string("state", SysIdRoutineLog.stateEnumToString(state))
