"""RobotPy itself, in WPILib's own simulation, in the place of most fakes.

Motors, encoders and the SysIdRoutine stay those of the fakes, so that they turn the bench's shafts
and tell what they are asked for. A motor derives from RobotPy's own as well: so RobotPy's other
classes take it, and call it.
"""

import threading
import time
from typing import Any

from grader.robotcode.library import sysid, timing
from grader.robotcode.library.base import JAVA, PYTHON, FakeType
from grader.robotcode.library.devices import Device
from grader.robotcode.library.world import PERIOD, WORLD

OWNER = "commands2.Subsystem"


class Mechanism(sysid.Mechanism):
    """What a routine moves, with a subsystem of RobotPy's."""

    _owner = OWNER


class SysIdRoutine(sysid.SysIdRoutine):
    """The tests, as commands of RobotPy's."""

    Mechanism = Mechanism

    def _assemble(self, name: str, start: Any, run: Any, end: Any) -> Any:
        return super()._assemble(name, start, run, lambda _interrupted: end())


class Scheduler:
    """RobotPy's scheduler, with the simulation's clock and driver station before every loop."""

    def __init__(self) -> None:
        import commands2  # noqa: PLC0415 - only where it is installed

        self.real = commands2.CommandScheduler.getInstance()
        self.schedule, self.cancel = self.real.schedule, self.real.cancel
        self.isScheduled, self.cancelAll = self.real.isScheduled, self.real.cancelAll

    def run(self) -> None:
        """Run one loop."""
        from wpilib import DriverStation, Timer, simulation  # noqa: PLC0415 - as above

        station = simulation.DriverStationSim
        station.setDsAttached(True)
        station.setEnabled(WORLD.enabled)
        station.setTest(WORLD.mode == "test")
        station.setAutonomous(WORLD.mode == "autonomous")
        station.notifyNewData()
        DriverStation.refreshData()
        simulation.stepTiming(max(0.0, WORLD.time + PERIOD - Timer.getFPGATimestamp()))
        self.real.run()


def use_wpilib() -> None:
    """Put the fakes of devices and of the SysIdRoutine into RobotPy, and start the simulation."""
    import commands2.sysid  # noqa: PLC0415 - as above
    import hal  # noqa: PLC0415 - as above
    import wpilib.simulation  # noqa: PLC0415 - as above
    import wpilib.sysid  # noqa: PLC0415 - as above

    for name, cls in PYTHON["wpilib"].items():
        own = getattr(wpilib, name, None)
        if isinstance(own, type) and isinstance(cls, type) and issubclass(cls, Device):
            setattr(wpilib, name, _join(name, cls, own))
    JAVA[OWNER] = commands2.Subsystem
    robot: Any = wpilib.RobotBase  # of any type, since its members are replaced
    tests: Any = commands2.sysid
    log: Any = wpilib.sysid
    tests.SysIdRoutine = SysIdRoutine
    log.SysIdRoutineLog = sysid.SysIdRoutineLog
    log.State = sysid.State
    wpilib.wait = timing.wait
    for name in ("getBatteryVoltage", "getInputVoltage"):
        setattr(wpilib.RobotController, name, staticmethod(lambda: WORLD.battery))
    robot.isReal = staticmethod(lambda: True)
    robot.isSimulation = staticmethod(lambda: False)
    real = hal.RuntimeType.HAL_Runtime_RoboRIO2
    hal.getRuntimeType = robot.getRuntimeType = staticmethod(lambda: real)
    wpilib.simulation.pauseTiming()
    wpilib.simulation.restartTiming()
    WORLD.singletons["scheduler v3"] = Scheduler()


def _join(name: str, fake: Any, real: Any) -> type:  # classes
    """A class that is a fake's, and for RobotPy one of its own."""

    def start(self: Any, *args: Any, **named: Any) -> None:
        real.__init__(self, *args, **named)
        fake.__init__(self, *args, **named)

    both = type("Both", (FakeType, type(real)), {})
    return both(name, (fake, real), {"__init__": start})  # type: ignore[no-any-return]


def stop_clock() -> None:
    """Let Python's own clock be the bench's."""
    really_sleep = time.sleep

    def sleep(seconds: Any) -> None:
        own = threading.current_thread() is threading.main_thread()
        (timing.wait if own else really_sleep)(float(seconds))

    time.sleep = sleep
    time.time = time.monotonic = time.perf_counter = timing.Timer.getTimestamp
