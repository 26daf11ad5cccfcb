from commands2.sysid import SysIdRoutine

<<<<<<< HEAD
STEP = 3.5
=======
STEP = 7.0
>>>>>>> practice-bot
