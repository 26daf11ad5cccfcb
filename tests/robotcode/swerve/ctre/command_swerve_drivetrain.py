import math

from commands2 import Command, Subsystem
from commands2.sysid import SysIdRoutine
from phoenix6 import SignalLogger, swerve
from wpilib.sysid import SysIdRoutineLog


class CommandSwerveDrivetrain(Subsystem, swerve.SwerveDrivetrain):
    """The generator's Python: three routines, of which one is applied."""

    def __init__(self, constants, modules) -> None:
        Subsystem.__init__(self)
        swerve.SwerveDrivetrain.__init__(self, constants, modules)
        self._translation = swerve.requests.SysIdSwerveTranslation()
        self._rotation = swerve.requests.SysIdSwerveRotation()

        self._sys_id_routine_translation = SysIdRoutine(
            SysIdRoutine.Config(
                # 1 V/s, as WPILib has it
                stepVoltage=4.0,
                recordState=lambda state: SignalLogger.write_string(
                    "SysIdTranslation_State",
                    SysIdRoutineLog.stateEnumToString(state),
                ),
            ),
            SysIdRoutine.Mechanism(
                lambda output: self.set_control(self._translation.with_volts(output)),
                lambda log: None,
                self,
            ),
        )
        self._sys_id_routine_rotation = SysIdRoutine(
            SysIdRoutine.Config(
                # in truth radians per second squared, and radians per second
                rampRate=math.pi / 6,
                stepVoltage=math.pi,
                recordState=lambda state: SignalLogger.write_string(
                    "SysIdRotation_State",
                    SysIdRoutineLog.stateEnumToString(state),
                ),
            ),
            SysIdRoutine.Mechanism(self._turn, lambda log: None, self),
        )
        self._routine_to_apply = self._sys_id_routine_translation

    def _turn(self, output: float) -> None:
        self.set_control(self._rotation.with_rotational_rate(output))
        SignalLogger.write_double("Rotational_Rate", output)

    def sys_id_quasistatic(self, direction: SysIdRoutine.Direction) -> Command:
        return self._routine_to_apply.quasistatic(direction)

    def sys_id_dynamic(self, direction: SysIdRoutine.Direction) -> Command:
        return self._routine_to_apply.dynamic(direction)
