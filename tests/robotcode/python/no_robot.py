"""Homework of another course."""


class SysId:
    def __init__(self, routine):
        self.routine = routine


print(SysId("SysIdRoutine").routine)
