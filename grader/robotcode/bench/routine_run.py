"""Runs the four tests of a program's SysIdRoutine, and records its behavior.

Works on whatever stands for the robot: the fakes, or WPILib's own simulation.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from grader.robotcode.bench.comparison import compare_motor, compare_signal
from grader.robotcode.bench.facts import (
    TESTS,
    DeviceFacts,
    RoutineFacts,
    Sent,
    Setting,
    Stop,
    TestRun,
)
from grader.robotcode.bench.simulation import (
    BATTERY,
    SAGGED,
    Mount,
    Simulation,
    find_device_number,
    walk_fields,
)
from grader.robotcode.library.base import Unknown
from grader.robotcode.library.commands import CommandScheduler
from grader.robotcode.library.devices import LogEntry, Motor
from grader.robotcode.library.world import PERIOD, WORLD

REST = 0.6  # [s] before every test; the first one until the robot knows that it is enabled
LONGEST = 14.0  # [s] a test that was left alone so long has no timeout worth the name
HICCUP = (0.8, 1.2)  # [s] of a dynamic test in which something else takes current


@dataclass
class Row:
    """One loop of a test.

    Args:
        time: [s] since the test began.
        asked: voltage that the test asked for [V].
        applied: voltage of each motor [V] when the callbacks were over.
        truth: voltage, position and velocity of each motor as the log callback found them.
        entries: what the log callback wrote.
    """

    time: float
    asked: float
    truth: dict[str, tuple[Any, float, float]] = field(default_factory=dict)
    applied: dict[str, Any] = field(default_factory=dict)
    entries: list[LogEntry] = field(default_factory=list)
    flipped: set[str] = field(default_factory=set)
    battery: float = BATTERY
    limits: dict[str, float] = field(default_factory=dict)  # share of it that gets through
    logged: bool = False


class StoppedError(Exception):
    """The program ended unexpectedly."""

    def __init__(self, stop: Stop) -> None:
        super().__init__(stop.said)
        self.stop = stop


class Bench:
    """A program on the bench, with the place of ``Stop`` and the test that are running.

    Args:
        subject: the program.
        mounts: how the task's motors are built in, by the number of their port.
    """

    kind: type[Any]  # of the facts
    where: str = "start"
    test: str = ""

    def __init__(self, subject: Any, mounts: dict[Any, Mount]) -> None:
        self.subject, self.mounts = subject, mounts

    def run(self) -> Any:
        """Make the program's class, run it, and return the facts."""
        facts: dict[str, Any] = {"language": self.subject.language, "name": self.subject.name}
        try:
            self.guard(self.subject.start)
            self.look(facts)
        except StoppedError as stopped:
            facts["stop"] = stopped.stop
        self.record_final_state(facts)
        return self.kind(season=self.subject.season, **self.subject.describe() | facts)

    def look(self, facts: dict[str, Any]) -> None:
        """Write down what happens as long as the program runs."""
        raise NotImplementedError

    def record_final_state(self, facts: dict[str, Any]) -> None:
        """Record the state after the end of the program."""
        raise NotImplementedError

    def guard(self, run: Callable[[], Any]) -> Any:
        """Run a part of the program.

        Raises:
            StoppedError: it raised an error, or does not come back.
        """
        try:
            return run()
        except StoppedError:
            raise
        except BaseException as error:
            if isinstance(error, KeyboardInterrupt | MemoryError):
                raise
            outcome, said, line, kind = self.subject.explain(error)
            raise StoppedError(Stop(outcome, self.where, said, line, self.test, kind)) from error


class RoutineBench(Bench):
    """A program with its routine, and its behavior in the tests."""

    kind = RoutineFacts

    def __init__(self, subject: Any, mounts: dict[Any, Mount]) -> None:
        super().__init__(subject, mounts)
        self.row: Row | None = None
        self.sent: dict[str, dict[Sent, None]] = {}

    def look(self, facts: dict[str, Any]) -> None:
        """Find the routine, and run all four tests."""
        facts |= self._describe_program()
        if "drive" in facts:
            facts["tests"] = dict(self._list_tests(facts))

    def record_final_state(self, facts: dict[str, Any]) -> None:
        """Record the devices."""
        facts["devices"] = self._list_devices()

    # -- what there is ----------------------------------------------------------------------

    def _describe_program(self) -> dict[str, Any]:
        """Find the routine, its settings and its devices."""
        ways = list(walk_fields(self.subject.instance))
        held = {id(one) for _, _, one in ways}
        made = WORLD.routines
        kept = [one for one in made if id(one) in held]
        if not kept:
            kept = self.guard(self.subject.find_routines)
        if not kept:  # others in the program may have made some of their own
            made = [one for one in made if one._mechanism._subsystem is self.subject.instance]
        names: dict[int, str] = {}
        for name, way, one in ways:
            names.setdefault(id(one), way if [n for n, _, _ in ways].count(name) > 1 else name)
        self.simulation = Simulation(names, self.mounts, self.subject.refill)
        self.at_start = {id(one): one._inverted for one in self.simulation.motors}
        found: dict[str, Any] = {"is_subsystem": is_subsystem(self.subject.instance)}
        if not made:
            return found
        self.routine = max(kept or made, key=lambda one: (one._mechanism._log is not None, 0))
        config, mechanism = self.routine._config, self.routine._mechanism
        for name in ("ramp", "step", "timeout"):
            found[name] = _read_setting(config, name)
        if isinstance(mechanism, Unknown):
            return found | {"line": int(self.routine._line), "kept": bool(kept)}
        own = mechanism._subsystem is self.subject.instance
        return found | {
            "line": int(self.routine._line),
            "kept": bool(kept),
            "requires": "none" if mechanism._forgotten else "own" if own else "other",
            "swapped": self.routine._swapped,
            "drive": mechanism._drive is not None,
            "log": mechanism._log is not None,
            "own_log": config.recordState is not None,
        }

    def _list_devices(self) -> tuple[DeviceFacts, ...]:
        if not hasattr(self, "simulation"):
            return ()
        found = []
        for one in WORLD.devices:
            motor = isinstance(one, Motor)
            leader = self.simulation.find_leader(one) if isinstance(one, Motor) else None
            lost = motor and one._leader is not None and leader is None
            turner = self.simulation.turned_by.get(id(one))
            number = find_device_number(one)
            found.append(
                DeviceFacts(
                    self.simulation.name(one),
                    type(one).__name__,
                    motor,
                    " ".join(map(str, one._port)),
                    None if number is None else float(number),
                    int(one._line),
                    "?" if lost else self.simulation.name(leader) if leader is not None else "",
                    bool(getattr(one, "_inverted", False)),
                    isinstance(one, Motor) and self.simulation.direction(one) < 0,
                    motor and number in self.mounts,
                    self.simulation.name(turner) if turner is not None else "",
                    _find_gearing(one),
                )
            )
        return tuple(found)

    # -- the tests --------------------------------------------------------------------------

    def _list_tests(self, facts: dict[str, Any]) -> Iterator[tuple[str, TestRun]]:
        self._wrap_callbacks()
        self.scheduler = CommandScheduler()
        for test in TESTS:
            WORLD.mode, WORLD.battery, self.simulation.hiccup = "test", BATTERY, False
            self._wait_at_rest()
            try:
                yield test, self._hold_button(test)
            except StoppedError as stopped:
                facts["stop"] = stopped.stop
                return

    def _wrap_callbacks(self) -> None:
        mechanism = self.routine._mechanism
        drive, log = mechanism._drive, mechanism._log

        def drive_callback(voltage: Any) -> None:
            self._note_commands("periodic")
            self.where = "drive"
            if self.row is not None:
                self.row.asked = _in_volts(voltage)
            WORLD.battery = BATTERY  # it sags once the motors have their shares of it
            drive(voltage)
            self._note_commands("drive")
            self._sag_battery_briefly()
            self.simulation.settle()
            self._note_truth()  # where there is no log callback
            self.where = "command"

        def log_callback(record: Any) -> None:
            WORLD.logged.clear()
            self.where = "log"
            self._note_truth()
            if self.row is not None:
                self.row.logged = True
            log(record)
            self._note_commands("log")
            if self.row is not None:
                self.row.entries = [e for e in WORLD.logged if e.signal != "state"]
            self.where = "command"

        if drive is not None:
            mechanism._drive = drive_callback
        if log is not None:
            mechanism._log = log_callback

    def _note_truth(self) -> None:
        if self.row is not None:
            self.row.truth = {
                self.simulation.name(one): (one._applied, *one._read_rotor())
                for one in self.simulation.motors
            }

    def _sag_battery_briefly(self) -> None:
        """Reduce the voltage for a moment, so that requested and applied voltage differ."""
        row = self.row
        now = (
            row is not None and self.test.startswith("dynamic") and HICCUP[0] < row.time < HICCUP[1]
        )
        self.simulation.hiccup = now
        WORLD.battery = SAGGED if now else BATTERY

    def _note_commands(self, phase: str) -> None:
        for one in self.simulation.motors:
            sent = self.sent.setdefault(self.simulation.name(one), {})
            for command in one._commands:
                sent.setdefault(Sent(command.kind, command.method, int(command.line), phase))
            one._commands.clear()

    def _wait_at_rest(self) -> None:
        self.test, self.row, self.where = "", None, "periodic"
        for _ in range(round(REST / PERIOD)):
            self.guard(lambda: self.simulation.run_loop(self.scheduler.run))
        for one in self.simulation.motors:  # carried back to where it began
            one._shaft.position = one._shaft.velocity = 0.0

    def _hold_button(self, test: str) -> TestRun:
        """Hold down the button of a test, until it ends or has shown enough."""
        self.test, self.sent = test, {}
        kind, way = test.split("-")
        direction = find_direction(self.routine, way)
        self.where = "command"
        command = self.guard(lambda: getattr(self.routine, kind)(direction))
        self.guard(lambda: self.scheduler.schedule(command))
        rows: list[Row] = []
        blocked, began, lasted = WORLD.blocked, WORLD.time, math.inf
        before = {id(one): one._inverted for one in self.simulation.motors}
        for _ in range(round(LONGEST / PERIOD)):
            self.row = Row(WORLD.time - began, math.nan)
            self.where = "periodic"
            self.guard(lambda: self.simulation.run_loop(self.scheduler.run))
            self._note_commands("other")
            row, self.row = self.row, None
            if not self.scheduler.isScheduled(command):
                lasted = row.time
                break
            if not math.isnan(row.asked):
                row.battery = WORLD.battery
                for one in self.simulation.motors:
                    name = self.simulation.name(one)
                    row.applied[name] = one._applied
                    row.limits[name] = self.simulation.find_voltage_share(one)
                    if one._inverted != before[id(one)]:
                        row.flipped.add(name)
                rows.append(row)
        else:
            self.scheduler.cancel(command)
        return self._sum_up(rows, lasted, WORLD.blocked - blocked)

    def _sum_up(self, rows: list[Row], lasted: float, blocked: float) -> TestRun:
        motors = {
            self.simulation.name(one): compare_motor(
                self.simulation.name(one), rows, tuple(self.sent.get(self.simulation.name(one), ()))
            )
            for one in self.simulation.motors
        }
        logged = [row for row in rows if row.logged]
        pairs: dict[str, dict[str, None]] = {}
        for row in logged:
            for entry in row.entries:
                pairs.setdefault(str(entry.motor), {})[entry.signal] = None
        signals = {
            name: {signal: compare_signal(name, signal, logged) for signal in listed}
            for name, listed in pairs.items()
        }
        return TestRun(lasted, len(rows), len(logged), motors, signals, blocked)


def find_direction(routine: Any, way: str) -> Any:
    """The constant of a routine's Direction."""
    ways = type(routine).Direction
    name = f"k{way.capitalize()}"
    return getattr(ways, name) if hasattr(ways, name) else getattr(ways, way.upper())


def is_subsystem(thing: Any) -> bool:
    """Whether an object is a subsystem, or a mechanism of Commands v3."""
    return any(base.__name__ in {"Subsystem", "Mechanism"} for base in type(thing).__mro__)


def _in_volts(voltage: Any) -> float:
    value = getattr(voltage, "_base", voltage)
    return float(value) if isinstance(value, int | float) else math.nan


def _read_setting(config: Any, name: str) -> Setting:
    if isinstance(config, Unknown):
        return Setting(text=config.unknown_text)
    given = config._given.get(name, "default")
    value = getattr(config, f"_{name}")
    known = isinstance(value, int | float) and not isinstance(value, bool)
    default = isinstance(given, str) and given == "default"
    text = given.unknown_text if isinstance(given, Unknown) else "" if default else str(given)
    problem = config._problems.get(name, "")
    return Setting(
        float(value) if known and not problem else None,
        default,
        text,
        int(config._line),
        problem,
        "M-UNITS" if problem else "",
    )


def _find_gearing(device: Any) -> float:
    value = getattr(device, "_gearing", 1.0)
    return float(value) if isinstance(value, int | float) and value else 1.0
