"""A robot without a routine, with a class of that name's neighbors."""

from wpilib import TimedRobot


class SysId(TimedRobot):
    pass
