from commands2.sysid import SysIdRoutine

routine = SysIdRoutine(
    SysIdRoutine.Config(0.5, 3.5, 10)),
    SysIdRoutine.Mechanism(drive, log, self),
)
