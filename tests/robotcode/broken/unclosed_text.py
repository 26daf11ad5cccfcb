"""The docstring that never ends.

from commands2.sysid import SysIdRoutine
