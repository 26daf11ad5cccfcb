from commands2.sysid import SysIdRoutine

print "starting"
routine = SysIdRoutine(SysIdRoutine.Config(), None)
