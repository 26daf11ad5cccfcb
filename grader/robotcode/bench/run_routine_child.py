"""Runs a learner's SysIdRoutine in WPILib's own simulation, as a program of its own.

    python run_routine_child.py FILE CLASS FOLDER SECONDS

The real scheduler runs the four tests of the routine that CLASS in FILE makes; what its motor
controllers put out moves a motor model each, whose motion its encoders see. FOLDER gets
``robot.wpilog``, what the robot itself wrote down, whole only once the interpreter has ended, and
``seen.json``, what the bench saw. Standard input holds a nonce; once all tests are over, it is
printed with the digest of ``seen.json``, which shows that the program came to its end. Nothing of
the course is imported.
"""

import faulthandler
import hashlib
import importlib.util
import inspect
import json
import math
import os
import sys
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

PERIOD = 0.02  # [s] one loop of a robot program
REST = 1.0  # [s] before every test; the first one until the robot knows that it is enabled
LONGEST = 20.0  # [s] a test that was left alone so long has no timeout worth the name
SHORT = {"quasistatic-reverse": 4.0, "dynamic-forward": 1.6, "dynamic-reverse": 1.6}  # [s]
BATTERY = 11.0  # [V] a tired one: twelfths of it are no volts
SAGGED, SAG = 10.5, (0.8, 1.2)  # [V], [s] of a dynamic test in which something else takes current
GAINS = {"ks": 0.2, "kv": 2.4, "ka": 0.3}  # V, V·s/m, V·s²/m: a drivetrain; further motors differ
STEP = {"ks": 0.03, "kv": 0.12, "ka": 0.02}  # ... by this, so that their records can be told apart
METERS_PER_PULSE = 0.000156  # of the encoders
CHANNELS, DEEP = 20, 4  # for PWM on a roboRIO; fields of fields that are looked into


class CannotRun(Exception):  # noqa: N818 - says what is lacking; no fault of the learner's
    """The program cannot be run in the simulation."""


def get_by_season_name(thing: Any, name: str) -> Any:  # noqa: ANN401 - RobotPy's own classes have no types here
    """An attribute by its name of 2026 (``setVInVoltage``) or of 2027."""
    snake = "".join(f"_{a.lower()}" if a.isupper() else a for a in name)
    return getattr(thing, name if hasattr(thing, name) else snake)


class Wheel:
    """The simulated load of a motor: V = kS·sgn(v) + kV·v + kA·a."""

    def __init__(self, number: int) -> None:
        self.ks, self.kv, self.ka = (GAINS[name] + number * STEP[name] for name in GAINS)
        self.position = self.velocity = 0.0  # [m], [m/s]

    def move(self, voltage: float) -> None:
        """Advance by one loop: the exact solution, except in the loop in which it comes to rest."""
        after = 0.0
        if self.velocity or abs(voltage) > self.ks:
            final = (voltage - math.copysign(self.ks, self.velocity or voltage)) / self.kv
            share = -math.expm1(-PERIOD * self.kv / self.ka)
            after = self.velocity + (final - self.velocity) * share
            after = 0.0 if after * self.velocity < 0.0 else after
        self.position += (self.velocity + after) / 2.0 * PERIOD
        self.velocity = after


class Bench:
    """A subsystem with its routine, and all that its motors move."""

    def __init__(self, subsystem: Any) -> None:  # noqa: ANN401 - the same
        import wpilib  # noqa: PLC0415 - whoever only reads needs none
        from commands2.sysid import SysIdRoutine  # noqa: PLC0415 - the same
        from wpilib import simulation  # noqa: PLC0415 - the same

        self.simulation, self.routine_type, self.subsystem = simulation, SysIdRoutine, subsystem
        fields = list(walk_fields(subsystem))
        routines = [one for _, one in fields if isinstance(one, SysIdRoutine)]
        if not routines:
            raise CannotRun(f"{type(subsystem).__name__} keeps no SysIdRoutine in a field")
        self.routine = routines[0]
        self.motors = dict(self._motors(fields, wpilib))
        if not self.motors:
            raise CannotRun("WPILib simulates none of its motors")
        self.wheels = [Wheel(number) for number in range(len(self.motors))]
        own = {name: one for name, one in fields if isinstance(one, wpilib.Encoder)}
        self.encoders = [simulation.EncoderSim(one) for one in own.values()]
        self.turned_by = [self._partner(name, at / len(own)) for at, name in enumerate(own)]
        self.per_pulse = [
            abs(get_by_season_name(one, "getDistancePerPulse")()) for one in self.encoders
        ]
        self.distances = [0.0] * len(self.encoders)  # in the program's own unit
        self.voltages = [0.0] * len(self.motors)  # [V] at the motors
        self.rows: list[tuple[str, float, float, list[float], list[float]]] = []
        self.test, self.began, self.asked = "", 0.0, 0.0
        self.set_battery_voltage(BATTERY)

    def _motors(self, fields: list[tuple[str, Any]], wpilib: ModuleType) -> Iterator[Any]:
        """Name -> the share of the battery each motor gets, as its own program counts."""
        seen = set()
        for name, one in fields:
            if isinstance(one, wpilib.PWMMotorController):
                seen.add(get_by_season_name(one, "getChannel")())
                yield name, one.get if hasattr(one, "get") else one.get_throttle
        for channel in range(CHANNELS):
            pwm = self.simulation.PWMSim(channel)
            if channel not in seen and get_by_season_name(pwm, "getInitialized")():
                yield f"PWM {channel}", get_by_season_name(pwm, "getSpeed")

    def _partner(self, encoder: str, share: float) -> int:
        """The motor that turns an encoder: ``left`` for ``left_encoder``, else by their order."""
        near = (number for number, name in enumerate(self.motors) if name in encoder)
        return next(near, int(share * len(self.motors)))

    def set_battery_voltage(self, voltage: float) -> None:
        """Set the battery's voltage [V]."""
        self.volts = voltage
        get_by_season_name(self.simulation.RoboRioSim, "setVInVoltage")(voltage)

    def wrap_callbacks(self, now: Callable[[], float]) -> None:
        """Wrap the routine's two callbacks, so that their calls are recorded."""
        drive, log = self.routine.mechanism.drive, self.routine.mechanism.log

        def drive_callback(voltage: float) -> None:
            self.set_battery_voltage(BATTERY)
            self.asked = float(voltage)
            drive(voltage)
            passed = now() - self.began
            if self.test.startswith("dynamic") and SAG[0] < passed < SAG[1]:
                self.set_battery_voltage(SAGGED)
            self.voltages = [duty() * self.volts for duty in self.motors.values()]

        def log_callback(record: Any) -> None:  # noqa: ANN401 - the same
            seen = list(self.voltages), list(self.distances)
            self.rows.append((self.test, now(), self.asked, *seen))
            log(record)

        self.routine.mechanism.drive = drive_callback
        self.routine.mechanism.log = log_callback

    def run_loop(self, run: Callable[[], None]) -> None:
        """Run one loop of the robot program, and move the mechanisms meanwhile."""
        from wpilib import DriverStation  # noqa: PLC0415 - whoever only reads needs none

        get_by_season_name(self.simulation.DriverStationSim, "notifyNewData")()
        get_by_season_name(DriverStation, "refreshData")()
        run()
        self.voltages = [duty() * self.volts for duty in self.motors.values()]
        for wheel, voltage in zip(self.wheels, self.voltages, strict=True):
            wheel.move(voltage)
        for number, encoder in enumerate(self.encoders):
            wheel = self.wheels[self.turned_by[number]]
            size = self.per_pulse[number] / METERS_PER_PULSE  # the same pulses, whatever they mean
            self.distances[number] = wheel.position * size
            get_by_season_name(encoder, "setDistance")(self.distances[number])
            get_by_season_name(encoder, "setRate")(wheel.velocity * size)
        get_by_season_name(self.simulation, "stepTiming")(PERIOD)

    def observe(self) -> dict[str, object]:
        """Run the four tests; the recorded values, and each test's duration [s]."""
        import commands2  # noqa: PLC0415 - whoever only reads needs none
        from wpilib import Timer  # noqa: PLC0415 - the same

        scheduler = get_by_season_name(commands2.CommandScheduler, "getInstance")()
        now = get_by_season_name(Timer, "getFPGATimestamp")
        self.wrap_callbacks(now)
        ways, lasted = self.routine_type.Direction, {}
        for kind in ("quasistatic", "dynamic"):
            for way in ("forward", "reverse"):
                self._rest(scheduler)
                self.test, self.began = f"{kind}-{way}", now()
                name = f"k{way.capitalize()}"
                direction = getattr(ways, name if hasattr(ways, name) else way.upper())
                lasted[self.test] = self._hold(getattr(self.routine, kind)(direction), scheduler)
        self._rest(scheduler)
        told = {"lasted": lasted, "required": self.required, "per_pulse": self.per_pulse}
        return {**told, "motors": list(self.motors), "rows": self.rows}

    def _rest(self, scheduler: Any) -> None:  # noqa: ANN401 - the same
        self.test = ""
        for _ in range(round(REST / PERIOD)):
            self.run_loop(scheduler.run)

    def _hold(self, command: Any, scheduler: Any) -> float:  # noqa: ANN401 - the same
        """Hold down the button of a test, until it ends or has shown enough."""
        loops = round(SHORT.get(self.test, LONGEST) / PERIOD)
        self.required = self.subsystem in get_by_season_name(command, "getRequirements")()
        scheduler.schedule(command)
        for passed in range(loops):
            self.run_loop(scheduler.run)
            if not get_by_season_name(command, "isScheduled")():
                return passed * PERIOD
        command.cancel()
        return loops * PERIOD


def walk_fields(thing: object) -> Iterator[tuple[str, Any]]:
    """An object's fields and what they hold, each object once, with the names that lead there."""
    seen: set[int] = set()

    def fields(one: object, name: str, depth: int) -> Iterator[tuple[str, Any]]:
        if id(one) in seen or depth > DEEP or isinstance(one, (str, bytes, type, ModuleType)):
            return
        seen.add(id(one))
        yield name, one
        if isinstance(one, (dict, list, tuple, set, frozenset)):
            pairs = one.items() if isinstance(one, dict) else enumerate(one)
            below = [(f"{name}[{key!r}]", value) for key, value in pairs]
        else:
            own = {**vars(type(one)), **getattr(one, "__dict__", {})}
            below = [
                (f"{name}.{key}".lstrip("."), value)
                for key, value in own.items()
                if not key.startswith("__") and not callable(value)
            ]
        for key, value in below:
            yield from fields(value, key, depth + 1)

    return fields(thing, "", 0)


def load_module(file: Path) -> ModuleType:
    """Import the learner's file as a module."""
    sys.path[:0] = [str(file.parent), str(file.parent.parent)]
    spec = importlib.util.spec_from_file_location(file.stem, file)
    if spec is None or spec.loader is None:
        raise CannotRun(f"Python cannot import {file.name}")
    module = importlib.util.module_from_spec(spec)
    sys.modules[file.stem] = module
    try:
        spec.loader.exec_module(module)
    except ModuleNotFoundError as error:
        top = (error.name or "").partition(".")[0]
        if top and importlib.util.find_spec(top) is None:
            raise CannotRun(f"it imports {top}, which is not here") from error
        raise
    return module


def make_subsystem(module: ModuleType, name: str) -> object:
    """Construct the learner's subsystem."""
    kind = getattr(module, name, None)
    if not isinstance(kind, type):
        raise CannotRun(f"there is no class {name} in it")
    needed = [
        one.name
        for one in inspect.signature(kind).parameters.values()
        if one.default is one.empty and one.kind not in {one.VAR_POSITIONAL, one.VAR_KEYWORD}
    ]
    if needed:
        raise CannotRun(f"{name}() has to be given {', '.join(needed)}")
    return kind()


def describe_crash(error: BaseException, file: Path) -> dict[str, object]:
    """The line and the error at which the learner's code stopped."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [one for one in frames if Path(one.filename).parent in {file.parent, file.parent.parent}]
    where = [one.name for one in frames if one.name in {"drive_callback", "log_callback"}]
    return {
        "file": Path(own[-1].filename).name if own else file.name,
        "line": own[-1].lineno if own else 0,
        "error": f"{type(error).__name__}: {error}".strip().splitlines()[0].rstrip(" :"),
        "where": where[-1].removesuffix("_callback") if where else "",
    }


def enable_test_mode(folder: Path) -> None:
    """Start the log, stop the clock, and switch the robot to test mode."""
    from wpilib import DataLogManager, simulation  # noqa: PLC0415 - whoever only reads needs none

    get_by_season_name(DataLogManager, "start")(str(folder), "robot.wpilog")
    get_by_season_name(DataLogManager, "logNetworkTables")(False)  # noqa: FBT003 - RobotPy takes it by position
    get_by_season_name(simulation, "pauseTiming")()
    get_by_season_name(simulation, "restartTiming")()
    for switch in ("setDsAttached", "setTest", "setEnabled"):
        get_by_season_name(simulation.DriverStationSim, switch)(True)  # noqa: FBT003 - the same


def run_file(file: Path, name: str, folder: Path, look: Callable[[Any], Any]) -> dict[str, object]:
    """Run one file; errors of the learner's code are part of the result."""
    bench = None
    try:
        enable_test_mode(folder)
        bench = look(make_subsystem(load_module(file), name))
        return dict(bench.observe())
    except CannotRun as lacking:
        return {"cannot": str(lacking)}
    except BaseException as error:  # noqa: BLE001 - a learner's code may raise whatever it likes
        what = describe_crash(error, file)
        if isinstance(error, (FileNotFoundError, PermissionError)):
            return {"cannot": f"it asks for what it cannot have here: {what['error']}"}
        return {"crash": what} if bench or what["line"] else {"cannot": what["error"]}


def sign_result(nonce: str, told: bytes) -> bytes:
    """What a program prints at its end: the nonce, and the digest of its results."""
    return f"{nonce} {hashlib.sha256(told).hexdigest()}".encode()


def start_child(look: Callable[[Any], Any] = Bench) -> None:
    """Run the file of the command line within its time limit, and write the results."""
    nonce, place = sys.stdin.read(), Path(sys.argv[3])
    out = os.dup(1)
    os.dup2(2, 1)  # what the learner's code prints is no word of ours
    stuck = (place / "endless.txt").open("w", encoding="utf-8")
    faulthandler.dump_traceback_later(float(sys.argv[4]), exit=True, file=stuck)
    told = json.dumps(run_file(Path(sys.argv[1]), sys.argv[2], place, look)).encode()
    (place / "seen.json").write_bytes(told)
    os.write(out, sign_result(nonce, told))


if __name__ == "__main__":
    start_child()
