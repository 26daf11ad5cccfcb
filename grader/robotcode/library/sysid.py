"""SysIdRoutine and its log: Commands v2 of 2024 to 2027, Commands v3 of 2027, and RobotPy."""

from collections.abc import Callable
from enum import Enum
from typing import Any

from grader.robotcode.library.base import JAVA, PYTHON, Fake, Unknown, WrongArgument, describe, fake
from grader.robotcode.library.commands import Command, FunctionalCommand, nothing
from grader.robotcode.library.devices import LogEntry
from grader.robotcode.library.timing import Timer
from grader.robotcode.library.units import CONSTANTS, Measure
from grader.robotcode.library.world import WORLD

VOLTS, SECONDS = CONSTANTS["Volts"], CONSTANTS["Seconds"]
RAMP, STEP, TIMEOUT = VOLTS.per(SECONDS).of(1.0), VOLTS.of(7.0), SECONDS.of(10.0)  # WPILib's
SIGNALS = (  # what Java calls the signal, RobotPy's unit of it, and what RobotPy calls that
    ("voltage", "Volts", "volt"),
    ("current", "Amps", "ampere"),
    ("linearPosition", "Meters", "meter"),
    ("linearVelocity", "MetersPerSecond", "meters_per_second"),
    ("linearAcceleration", "MetersPerSecondPerSecond", "meters_per_second_squared"),
    ("angularPosition", "Rotations", "turn"),
    ("angularVelocity", "RotationsPerSecond", "turns_per_second"),
    ("angularAcceleration", "RotationsPerSecondPerSecond", "turns_per_second_squared"),
)
MISSING = object()
TESTS = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse", "none")


class _State(Enum):
    def __str__(self) -> str:
        return self.value if WORLD.language == "java" else f"State.{self.name}"


State: Any = _State(  # type: ignore[call-arg]  # Enum makes a class of a name and members
    "State", {f"k{one.title().replace('-', '')}": one for one in TESTS}
)
State2027: Any = _State(  # type: ignore[call-arg]  # the same
    "State", {one.upper().replace("-", "_"): one for one in TESTS}
)
Direction = Enum("Direction", {"kForward": 1, "kReverse": -1})
Direction2027 = Enum("Direction", {"FORWARD": 1, "REVERSE": -1})


def _find_way(direction: Any) -> str:
    return "reverse" if direction.value == -1 else "forward"


def _show(value: Any) -> str:
    """A value for a message: a measure with its unit, anything else as in other messages."""
    if isinstance(value, Measure) and isinstance(size := value.magnitude(), int | float):
        return f"{size:g} {value._unit._symbol}"  # WPILib writes 5.000e-01 V
    return str(value) if isinstance(value, Measure) else describe(value)


@fake()
class _MotorLog(Fake):
    """The values that a log callback writes about one motor."""

    def __init__(self, motor: str) -> None:
        self._motor = motor

    def value(self, name: str, value: float, unit: str) -> "_MotorLog":
        """Log a number without any conversion."""
        return self._log_signal(name, value, "", unit)

    def _log_signal(self, signal: str, value: Any, family: str, unit: str) -> "_MotorLog":
        entry = LogEntry(self._motor, signal, value, family, unit, WORLD.where())
        WORLD.logged.append(entry)
        return self


def _make_method(name: str, constant: str, label: str) -> Callable[..., Any]:
    """A method that logs one signal, converted to SI."""
    family = next((one for one in ("linear", "angular") if name.startswith(one)), "")
    signal = name.removeprefix(family).lower()
    unit = CONSTANTS[constant]

    def log(self: _MotorLog, value: Any) -> _MotorLog:
        if isinstance(value, Unknown):
            return self._log_signal(signal, value, family, label)
        if WORLD.language == "python" and isinstance(value, int | float):
            return self._log_signal(signal, unit.toBaseUnits(value), family, label)
        if WORLD.language == "java" and isinstance(value, unit._kind):
            return self._log_signal(signal, value._base, family, value._unit._name)
        raise WrongArgument(f"{name} takes a value in units such as {constant}, not {_show(value)}")

    return log


def _make_motor_log(language: str) -> type[_MotorLog]:
    methods = {}
    for name, unit, label in SIGNALS:
        shown = name.removeprefix("linear") if language == "python" else name
        shown = shown[0].lower() + shown[1:]
        methods[shown] = _make_method(name, unit, label)
    return fake(complete=True)(type("MotorLog", (_MotorLog,), methods))


MOTOR_LOGS = {language: _make_motor_log(language) for language in ("java", "python")}


@fake("edu.wpi.first.wpilibj.sysid", "wpilib.sysid", complete=True)
class SysIdRoutineLog(Fake):
    """The log of a routine: allwpilib v2026.2.2, wpilibj/.../sysid/SysIdRoutineLog.java."""

    State = State
    MotorLog = MOTOR_LOGS["java"]

    def __init__(self, logName: str) -> None:
        self._log_name = logName

    def motor(self, motorName: str) -> Fake:
        return MOTOR_LOGS[WORLD.language](motorName)

    def recordState(self, state: Enum) -> None:
        WORLD.logged.append(LogEntry(self._log_name, "state", state.value, line=WORLD.where()))

    @staticmethod
    def stateEnumToString(state: Enum) -> str:
        return state.value


@fake("org.wpilib.sysid", name="SysIdRoutineLog", complete=True)
class SysIdRoutineLog2027(SysIdRoutineLog):
    """The same: allwpilib main, wpilibj/.../org/wpilib/sysid/SysIdRoutineLog.java."""

    State = State2027


@fake(complete=True)
class Config(Fake):
    """The settings of a routine.

    ``_ramp`` [V/s], ``_step`` [V] and ``_timeout`` [s] are what it was given. ``_given`` has each
    as the program passed it, or the word ``default``.
    """

    def __init__(
        self,
        rampRate: Any = RAMP,
        stepVoltage: Any = STEP,
        timeout: Any = TIMEOUT,
        recordState: Any = None,
    ) -> None:
        some = (rampRate is RAMP) != (timeout is TIMEOUT)
        if some and WORLD.language == "java" and type(self) is Config:
            raise WrongArgument("SysIdRoutine.Config takes three or four arguments, or none")
        self._line, self.recordState = WORLD.where(), recordState
        self._given: dict[str, Any] = {}
        self._problems: dict[str, str] = {}  # what was passed in place of a number of the kind
        self.rampRate = self._read_setting("ramp", rampRate, RAMP)
        self.stepVoltage = self._read_setting("step", stepVoltage, STEP)
        self.timeout = self._read_setting("timeout", timeout, TIMEOUT)

    def _read_setting(self, name: str, value: Any, default: Measure) -> Any:
        """A setting as the program gave it, or WPILib's default."""
        java = WORLD.language == "java"
        standard = value is default or (java and value is None)
        self._given[name] = "default" if standard else value
        kind = Unknown | default._unit._kind if java else Unknown | int | float
        if not standard and (isinstance(value, bool) or not isinstance(value, kind)):
            self._problems[name] = f"{_show(value)} for the {name}"
            return default if java else default._base
        standard_value = default if java else default._base
        return standard_value if standard else value

    _ramp = property(lambda self: getattr(self.rampRate, "_base", self.rampRate))
    _step = property(lambda self: getattr(self.stepVoltage, "_base", self.stepVoltage))
    _timeout = property(lambda self: getattr(self.timeout, "_base", self.timeout))


class ConfigV3(Config):
    """The settings of a routine of Commands v3, which takes no null for the first three."""

    DEFAULT_RAMP_RATE, DEFAULT_STEP_VOLTAGE, DEFAULT_TIMEOUT = RAMP, STEP, TIMEOUT

    def __init__(self, rampRate: Any, stepVoltage: Any, timeout: Any, recordState: Any) -> None:
        super().__init__(rampRate, stepVoltage, timeout, recordState)

    def _read_setting(self, name: str, value: Any, default: Measure) -> Any:
        if value is None:
            self._problems[name] = f"null for the {name}: Commands v3 takes no null there"
            self._given[name] = None
            return default
        return super()._read_setting(name, value, default)

    @staticmethod
    def useDataLog(rampRate: Any, stepVoltage: Any, timeout: Any) -> Config:
        return ConfigV3(rampRate, stepVoltage, timeout, None)

    @staticmethod
    def defaults() -> Config:
        return ConfigV3(RAMP, STEP, TIMEOUT, None)


@fake(complete=True)
class Mechanism(Fake):
    """The mechanism of a routine: its name and its callbacks."""

    _owner = "edu.wpi.first.wpilibj2.command.Subsystem"

    def __init__(
        self,
        drive: Callable[..., Any],
        log: Callable[..., Any],
        subsystem: Any = MISSING,
        name: Any = None,
    ) -> None:
        kind = JAVA[self._owner]
        self._forgotten = not isinstance(subsystem, Unknown | kind)
        if self._forgotten:  # the tests can be looked at all the same
            subsystem = kind()
        self._line = WORLD.where()
        self._drive, self._log, self._subsystem = drive, log, subsystem
        self._name = subsystem.getName() if name is None else name


class SysIdMechanism(Mechanism):
    """The mechanism of a routine of Commands v3: its name and its callbacks."""

    _owner = "org.wpilib.command3.Mechanism"


@fake(complete=True)
class Routine(SysIdRoutineLog):
    """The common part of the routines of all versions."""

    def __init__(self, config: Any, mechanism: Any) -> None:
        self._swapped = isinstance(config, Mechanism) and isinstance(mechanism, Config)
        if self._swapped:
            config, mechanism = mechanism, config
        for one, kind in ((config, Config), (mechanism, Mechanism)):
            if one is not None and not isinstance(one, kind | Unknown):
                raise WrongArgument(f"SysIdRoutine takes a {kind.__name__}, not {_show(one)}")
        if config is None or mechanism is None:
            raise WrongArgument(
                f"SysIdRoutine gets {describe(None)} for its config or its mechanism"
            )
        super().__init__(mechanism._name)
        self._line = WORLD.where()
        self._config, self._mechanism = config, mechanism
        WORLD.routines.append(self)

    def quasistatic(self, direction: Enum) -> Command:
        timer = Timer()
        return self._make_test(
            f"quasistatic-{_find_way(direction)}",
            timer.restart,
            lambda: direction.value * timer.get() * self._config._ramp,
        )

    def dynamic(self, direction: Enum) -> Command:
        def output() -> float:
            return direction.value * self._config._step

        return self._make_test(f"dynamic-{_find_way(direction)}", output, output)

    def _make_test(self, test: str, start: Callable[[], Any], output: Callable[[], Any]) -> Command:
        """A command, from its action at the start and the voltage of each loop."""
        mechanism, state = self._mechanism, self.State(test)

        def run() -> None:
            self._apply_volts(output())
            if mechanism._log is not None or WORLD.language == "python":
                mechanism._log(self)
            self._record_state(state)

        def end() -> None:
            self._apply_volts(0.0)
            self._record_state(self.State("none"))

        command = self._assemble_command(f"sysid-{state}-{mechanism._name}", start, run, end)
        WORLD.tests.append((test, command, WORLD.stack()))
        return command

    def _apply_volts(self, volts: Any) -> None:
        if self._mechanism._drive is None:
            raise WrongArgument(f"the drive callback is {describe(None)}")
        self._mechanism._drive(VOLTS.of(volts) if WORLD.language == "java" else volts)

    def _record_state(self, state: Enum) -> None:
        WORLD.running[self._log_name, id(self)] = state.value
        (self._config.recordState or self.recordState)(state)

    def _assemble_command(self, name: str, start: Any, run: Any, end: Any) -> Command:
        subsystem = self._mechanism._subsystem
        if self._config._timeout is None:
            raise WrongArgument("withTimeout() takes seconds, not None")
        test = subsystem.runOnce(start).andThen(subsystem.run(run)).finallyDo(end)
        return test.withName(name).withTimeout(self._config._timeout)


@fake("edu.wpi.first.wpilibj2.command.sysid", "commands2.sysid", complete=True)
class SysIdRoutine(Routine):
    """The tests: allwpilib v2026.2.2, .../command/sysid/SysIdRoutine.java; commands2/sysid."""

    Config, Mechanism, Direction = Config, Mechanism, Direction


@fake("org.wpilib.command2.sysid", name="SysIdRoutine", complete=True)
class SysIdRoutine2027(Routine, SysIdRoutineLog2027):
    """The same: allwpilib main, commandsv2/.../command2/sysid/SysIdRoutine.java."""

    Config, Mechanism, Direction = Config, Mechanism, Direction2027


@fake("org.wpilib.command3.sysid", name="SysIdRoutine", complete=True)
class SysIdRoutineV3(Routine, SysIdRoutineLog2027):
    """The tests: allwpilib main, commandsv3/.../command3/sysid/SysIdRoutine.java."""

    Config, SysIdMechanism, Direction = ConfigV3, SysIdMechanism, Direction2027

    def _assemble_command(self, name: str, start: Any, run: Any, end: Any) -> Command:
        subsystem = self._mechanism._subsystem
        test = FunctionalCommand(start, run, lambda _interrupted: end(), nothing, subsystem)
        return test.withName(name).withTimeout(self._config._timeout)


for _one, _name in ((SysIdRoutineLog2027, "SysIdRoutineLog"), (ConfigV3, "Config")):
    _one.__name__ = _name
SysIdRoutine2027.__name__ = SysIdRoutineV3.__name__ = "SysIdRoutine"
PYTHON.setdefault("wpilib.sysid", {})["State"] = State
