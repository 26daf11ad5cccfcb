"""A robot program for RobotPy's simulation: a flywheel runs the four tests of a SysIdRoutine.

    python robot_routine.py FOLDER NAME KS KV KA

writes FOLDER/NAME, which must not exist. Give it a process of its own and let that end by itself:
the log is written in the background and complete only then.
"""

import math
import sys

from commands2 import CommandScheduler, Subsystem
from commands2.sysid import SysIdRoutine
from wpilib import DataLogManager, DriverStation
from wpilib.simulation import DriverStationSim, pauseTiming, stepTiming
from wpilib.sysid import SysIdRoutineLog

PERIOD = 0.02  # [s] one loop
QUASISTATIC, DYNAMIC, REST = 10.0, 2.0, 1.5  # [s] two tests, and the pause between any two


class Flywheel(Subsystem):
    """A motor with friction and inertia: V = kS·sgn(v) + kV·v + kA·a, v in rotations per second."""

    def __init__(self, ks: float, kv: float, ka: float) -> None:
        super().__init__()
        self.ks, self.kv, self.ka = ks, kv, ka
        self.voltage = self.position = self.velocity = 0.0
        self.mechanism = SysIdRoutine.Mechanism(self.drive, self.log, self, "Fly-Wheel")

    def drive(self, voltage: float) -> None:
        """Apply a voltage."""
        self.voltage = voltage

    def log(self, log: SysIdRoutineLog) -> None:
        """Record what was applied and what a sensor would say."""
        motor = log.motor("shooter-left")
        motor.voltage(self.voltage)
        motor.angularPosition(self.position)
        motor.angularVelocity(self.velocity)

    def step(self) -> None:
        """Let one loop pass: exactly, apart from the moment it comes to rest."""
        way = self.velocity or self.voltage
        if self.velocity == 0.0 and abs(self.voltage) <= self.ks:
            return
        final = (self.voltage - math.copysign(self.ks, way)) / self.kv
        share = -math.expm1(-PERIOD * self.kv / self.ka)
        after = self.velocity + (final - self.velocity) * share
        if after * self.velocity < 0.0:
            after = 0.0
        self.position += (self.velocity + after) / 2.0 * PERIOD
        self.velocity = after


def loops(wheel: Flywheel, duration: float) -> None:
    """Run the robot for so long, enabled."""
    for _ in range(round(duration / PERIOD)):
        DriverStationSim.notifyNewData()
        DriverStation.refreshData()
        CommandScheduler.getInstance().run()
        wheel.step()
        stepTiming(PERIOD)


def main(folder: str, name: str, ks: float, kv: float, ka: float) -> None:
    """Run all four tests."""
    DataLogManager.start(folder, name)
    pauseTiming()
    for switch in (DriverStationSim.setDsAttached, DriverStationSim.setTest):
        switch(True)  # noqa: FBT003 - RobotPy takes it by position
    DriverStationSim.setEnabled(True)
    wheel = Flywheel(ks, kv, ka)
    loops(wheel, REST)  # until the robot knows that it is enabled: before, it would cancel a test
    slow = SysIdRoutine(SysIdRoutine.Config(timeout=QUASISTATIC), wheel.mechanism)
    fast = SysIdRoutine(SysIdRoutine.Config(timeout=DYNAMIC), wheel.mechanism)
    for test, duration in ((slow.quasistatic, QUASISTATIC), (fast.dynamic, DYNAMIC)):
        for way in (SysIdRoutine.Direction.kForward, SysIdRoutine.Direction.kReverse):
            test(way).schedule()
            loops(wheel, duration + REST)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], *map(float, sys.argv[3:6]))
