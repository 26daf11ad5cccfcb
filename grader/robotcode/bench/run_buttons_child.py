"""Presses every button of a robot in WPILib's own simulation, as a program of its own.

    python run_buttons_child.py FILE CLASS FOLDER SECONDS

CLASS in FILE is the robot's container. Each button of each controller is held for a moment and let
go, in test mode and driven by a person; FOLDER gets ``seen.json``: which test of SysId it started,
and whether that went on. Runs beside ``run_routine_child``, of which it is made.
"""

import importlib
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

PORTS, BUTTONS, HATS = 3, 14, (0, 90, 180, 270)  # a controller has so many, and a hat [deg]
HELD, AFTER = 6, 4  # [loops] a button is held, and watched after it
NONE = "kNone"


class Panel:
    """Every button of a robot's controllers, pressed in simulation."""

    def __init__(self, container: Any) -> None:  # noqa: ANN401 - RobotPy's own classes have no types here
        import commands2  # noqa: PLC0415 - whoever only reads needs none
        from commands2.sysid import SysIdRoutine  # noqa: PLC0415 - the same
        from wpilib import DriverStation, simulation  # noqa: PLC0415 - the same

        bench = importlib.import_module("run_routine_child")
        self.named = bench.get_by_season_name
        self.simulation, self.station = simulation, DriverStation
        self.sim = simulation.DriverStationSim
        self.period = bench.PERIOD
        self.scheduler = self.named(commands2.CommandScheduler, "getInstance")()
        self.now: set[str] = set()  # the tests that run
        routines = [one for _, one in bench.walk_fields(container) if isinstance(one, SysIdRoutine)]
        if not routines:
            raise bench.CannotRun("no SysIdRoutine is in a field of its subsystems")
        for routine in routines:
            routine.logState = self._watched(routine.logState)
        for port in range(PORTS):
            self.named(self.sim, "setJoystickButtonCount")(port, BUTTONS)
            self.named(self.sim, "setJoystickPOVCount")(port, 1)
            self.named(self.sim, "setJoystickPOV")(port, 0, -1)
            self.named(self.sim, "setJoystickAxisCount")(port, 6)

    def _watched(self, log: Callable[[Any], None]) -> Callable[[Any], None]:
        running = ""

        def log_state(state: Any) -> None:  # noqa: ANN401 - the same
            nonlocal running
            self.now.discard(running)
            running = "" if state.name == NONE else state.name
            self.now |= {running} - {""}
            log(state)

        return log_state

    def observe(self) -> dict[str, object]:
        """Press every button, and report the buttons that started a test."""
        presses = []
        for testing in (True, False):
            self.named(self.sim, "setTest")(testing)
            self._loops(AFTER)
            for port in range(PORTS):
                for button, press in self._buttons(port):
                    tests, stayed = self._pressed(press)
                    if tests:
                        where = {"test mode": testing, "port": port, "button": button}
                        presses.append({**where, "tests": tests, "stayed": stayed})
        return {"presses": presses}

    def _buttons(self, port: int) -> Iterator[tuple[str, Callable[[bool], None]]]:
        """The name of each button of a port, with a function that presses or releases it."""
        for number in range(1, BUTTONS + 1):
            yield str(number), partial(self._button, port, number)
        for angle in HATS:
            yield f"{angle} deg", partial(self._hat, port, angle)

    def _button(self, port: int, number: int, on: bool) -> None:  # noqa: FBT001 - WPILib's own order
        self.named(self.sim, "setJoystickButton")(port, number, on)

    def _hat(self, port: int, angle: int, on: bool) -> None:  # noqa: FBT001 - the same
        self.named(self.sim, "setJoystickPOV")(port, 0, angle if on else -1)

    def _pressed(self, press: Callable[[bool], None]) -> tuple[list[str], bool]:
        """The tests that a button started, and whether one went on when it was let go."""
        press(True)  # noqa: FBT003 - on
        started = self._loops(HELD)
        press(False)  # noqa: FBT003 - off
        self._loops(AFTER)
        stayed = bool(self.now)
        self.named(self.scheduler, "cancelAll")()
        return sorted(started), stayed

    def _loops(self, count: int) -> set[str]:
        """Let time pass; the tests that ran meanwhile."""
        seen = set()
        for _ in range(count):
            self.named(self.sim, "notifyNewData")()
            self.named(self.station, "refreshData")()
            self.scheduler.run()
            self.named(self.simulation, "stepTiming")(self.period)
            seen |= self.now
        return seen


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parent))  # where nobody has loaded it before
    bench = importlib.import_module("run_routine_child")
    del sys.path[0]
    bench.start_child(Panel)
