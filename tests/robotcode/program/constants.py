from dataclasses import dataclass

kRamp = 0.5


class ElevatorConstants:
    kStep = 2 * 1.75
    kTimeout = 10.0
