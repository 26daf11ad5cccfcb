"""Time, as WPILib measures it."""

from typing import Any

from grader.robotcode.library.base import PYTHON, Fake, fake
from grader.robotcode.library.world import WORLD

WPILIB = "edu.wpi.first.wpilibj org.wpilib.system"
NO_MATCH_TIME = -1.0  # [s] what a robot gets that no field has told the time


def in_seconds(value: Any) -> Any:  # a number, a Time, or unknown
    """A duration [s], whether it comes as a number or as a measure."""
    return float(value) if isinstance(value, int | float) else value.baseUnitMagnitude()


def wait(seconds: float) -> None:
    """Keep the whole program waiting."""
    WORLD.blocked += seconds
    WORLD.time += seconds


@fake(WPILIB, "wpilib", complete=True)
class Timer(Fake):
    """A stopwatch (allwpilib v2026, wpilibj/.../Timer.java)."""

    def __init__(self) -> None:
        self._elapsed = 0.0  # [s] in the times before it was last started
        self._started = WORLD.time
        self._running = False

    def get(self) -> float:
        """Time that it has run [s]."""
        return self._elapsed + (WORLD.time - self._started if self._running else 0.0)

    def start(self) -> None:
        if not self._running:
            self._started = WORLD.time
            self._running = True

    def stop(self) -> None:
        self._elapsed = self.get()
        self._running = False

    def reset(self) -> None:
        self._elapsed = 0.0
        self._started = WORLD.time

    def restart(self) -> None:
        self.reset()
        self._running = True

    def hasElapsed(self, period: Any) -> bool:  # a number or a Time
        return self.get() >= in_seconds(period)

    @staticmethod
    def delay(seconds: float) -> None:
        wait(seconds)

    @staticmethod
    def getFPGATimestamp() -> float:
        return WORLD.time

    getTimestamp = getMonotonicTimestamp = getFPGATimestamp

    @staticmethod
    def getMatchTime() -> float:
        return NO_MATCH_TIME


PYTHON.setdefault("wpilib", {}).update(wait=wait, getTime=Timer.getTimestamp)
