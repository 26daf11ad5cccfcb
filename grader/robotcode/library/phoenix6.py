"""Phoenix 6 of CTRE, as of 2026 (26.3): Talon FX and FXS, CANcoder, Pigeon, signals and requests.

Names and defaults are those of https://api.ctr-electronics.com/phoenix6/stable/java/, which
``phoenix6.toml`` lists. Configurations and requests are tables of fields, because they do nothing
but hold them. Python has all names in snake_case, with the exceptions that the file lists.
"""

import copy
import difflib
import functools
import re
import tomllib
from ast import literal_eval
from enum import Enum
from pathlib import Path
from typing import Any

from grader.robotcode.library.base import (
    NEARLY,
    Fake,
    NoSuchMember,
    Unknown,
    WrongArgument,
    accepts,
    checked,
    describe,
    fake,
)
from grader.robotcode.library.devices import Device
from grader.robotcode.library.hardware import VendorMotor, clamp, name_port, to_volts
from grader.robotcode.library.units import CONSTANTS, Angle, AngularVelocity, Measure, Voltage
from grader.robotcode.library.world import WORLD

CTRE = "com.ctre.phoenix6"
TABLES = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
DEFAULTS: dict[str, Any] = {}  # an enum -> its first member, a group -> its defaults


class StatusCode(Enum):
    """The result of a call: always OK here (.../phoenix6/StatusCode.html)."""

    OK = 0
    StatusCodeNotInitialized = -1  # where a loop begins that tries until it goes well
    STATUS_CODE_NOT_INITIALIZED = StatusCodeNotInitialized

    def isOK(self) -> bool:
        return self is StatusCode.OK

    def isError(self) -> bool:
        return self is not StatusCode.OK

    def isWarning(self) -> bool:
        return False

    is_ok, is_error, is_warning = isOK, isError, isWarning


OK = StatusCode.OK
fake(CTRE, "phoenix6 phoenix6.status_code")(StatusCode)
for _name, _members in TABLES["enums"].items():
    _names = {re.sub(r"(?<=[a-z])(?=[A-Z])", "_", one).upper(): one for one in _members.split()}
    _enum = Enum(_name, {one: one for one in _names.values()} | _names)
    fake(f"{CTRE}.signals", "phoenix6.signals")(_enum)
    DEFAULTS[_name] = next(iter(_enum))


def to_snake(name: str) -> str:
    """A name of Java's as Python has it."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def to_number(value: Any) -> Any:
    """A number in CTRE's units: rotations, and SI for the rest."""
    for kind, unit in ((Angle, "Rotations"), (AngularVelocity, "RotationsPerSecond")):
        if isinstance(value, kind):
            return value.in_(CONSTANTS[unit])
    return value.baseUnitMagnitude() if isinstance(value, Measure) else value


class Record(Fake):
    """Fields with defaults, and for each one a method ``with`` that returns the record itself."""

    _table, _needed = "", ""  # all fields; those that the constructor needs

    def __init__(self, *values: Any, **named: Any) -> None:
        cells = [cell.partition("=") for cell in self._table.split()]
        self._values = {
            name: copy.deepcopy(DEFAULTS[text]) if text in DEFAULTS else literal_eval(text or "0.")
            for name, _, text in cells
        }
        self._defaults = dict(self._values)
        needed = [cell.partition("=")[0] for cell in self._needed.split()]
        if len(values) + len(named) < len(needed):
            raise WrongArgument(f"{type(self).__name__} takes ({', '.join(needed)})")
        for name, value in (*zip(self._values, values, strict=False), *named.items()):
            setattr(self, name, to_number(value))

    def _find(self, name: str) -> str:
        """A field's name in Java. In Python it has underscores and may have no capitals."""
        if WORLD.language == "java":
            return name
        plain = name.replace("_", "").lower()
        return next((o for o in self._values if o.replace("_", "").lower() == plain), name)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        field, target = self._find(name), self._find(name.removeprefix("with"))
        if target not in self._values:
            target = target[:1].lower() + target[1:]
        if field in self._values:
            return self._values[field]
        if name.startswith("with") and target in self._values:
            return lambda value: setattr(self, target, to_number(value)) or self  # type: ignore[func-returns-value]  # it gives itself
        known = self._values if WORLD.language == "java" else map(to_snake, self._values)
        near = difflib.get_close_matches(name, known, 1, NEARLY)
        hint = f". Did you mean {near[0]}?" if near else ""
        raise NoSuchMember(f"{type(self).__name__} has no {name}{hint}")

    def __setattr__(self, name: str, value: Any) -> None:
        if name.startswith((".", "_")):
            self.__dict__[name] = value
            return
        getattr(self, name)
        field = self._find(name)
        default = self._defaults.get(field)
        known = default is not None and not isinstance(value, Unknown)
        if known and not accepts(type(default), value):
            raise WrongArgument(f"{field} takes another value than {describe(value)}")
        self._values[field] = value


def make_record(name: str, package: str, table: str, **members: Any) -> type:
    """A class of Phoenix 6 that only holds fields."""
    members |= {"_table": table, "__doc__": f"A table (.../phoenix6/{package}/{name}.html)."}
    return fake(f"{CTRE}.{package}", f"phoenix6.{package}")(type(name, (Record,), members))


GROUPS = TABLES["groups"]
GROUPS |= {"Slot1": GROUPS["Slot0"], "Slot2": GROUPS["Slot0"]}
for _name, _fields in {**GROUPS, "Slot": f"{GROUPS['Slot0']} SlotNumber=0"}.items():
    DEFAULTS[f"{_name}Configs"] = make_record(f"{_name}Configs", "configs", _fields)()
for _name, _groups in TABLES["devices"].items():
    _fields = " ".join(f"{one}={one}Configs" for one in _groups.split())
    _class = make_record(f"{_name}Configuration", "configs", f"{_fields} FutureProofConfigs=True")
    DEFAULTS[f"{_name}Configuration"] = _class()
REQUESTS = dict(TABLES["requests"])
for _name, (_needed, _more) in TABLES["closed_loops"].items():
    for _output in ("Voltage", "DutyCycle"):
        _fields = f"{_more} {{foc}} FeedForward Slot=0 {{brake}} {{limits}}"
        REQUESTS[_name + _output] = ("closed-loop", _needed, _fields)
    _fields = f"{_more} FeedForward Slot=0 {{coast}} {{limits}}"
    REQUESTS[f"{_name}TorqueCurrentFOC"] = ("closed-loop", _needed, _fields)
for _name, (_kind, _needed, _more) in REQUESTS.items():
    _fields = f"{_needed} {_more.format(**TABLES['shared'])}"
    make_record(_name, "controls", _fields, _kind=_kind, _needed=_needed)
fake(f"{CTRE}.controls", "phoenix6.controls", name="ControlRequest")(Record)


class StatusSignal(Fake):
    """A value that a device sends (.../phoenix6/StatusSignal.html and BaseStatusSignal.html).

    It stays what it was until somebody refreshes it.
    """

    def __init__(self, device: Any, name: str, unit: str) -> None:
        self._device, self._name, self._unit, self._value = device, name, unit, 0.0

    def _read_value(self) -> "StatusSignal":
        self._value = self._device._measure_signal(self._name)
        return self

    def _value_with_unit(self) -> Any:
        plain = WORLD.language == "python" or isinstance(self._value, Unknown)
        return self._value if plain or not self._unit else CONSTANTS[self._unit].of(self._value)

    def getValue(self) -> Any:
        return self._value_with_unit()

    def getValueAsDouble(self) -> float:
        return self._value

    def refresh(self, reportError: bool = True) -> "StatusSignal":
        return self._read_value()

    def asSupplier(self) -> Any:
        return lambda: self._read_value()._value_with_unit()

    @staticmethod
    def refreshAll(*signals: Any) -> StatusCode:
        for some in signals:
            for one in some if isinstance(some, list | tuple) else [some]:
                one._read_value() if isinstance(one, StatusSignal) else None
        return OK

    waitForUpdate = lambda self, *_settings: self._read_value()
    getLatencyCompensatedValue = staticmethod(lambda signal, *_more: signal._value_with_unit())
    getLatencyCompensatedValueAsDouble = staticmethod(lambda signal, *_more: signal._value)


for _name in ("StatusSignal", "BaseStatusSignal"):
    _modules = f"phoenix6 phoenix6.{to_snake(_name)}"
    fake(CTRE, _modules, complete=True, name=_name)(StatusSignal)


@fake(CTRE, "phoenix6 phoenix6.canbus", complete=True)
class CANBus(Fake):
    """A CAN bus, by its name (.../phoenix6/CANBus.html)."""

    def __init__(self, canbus: str = "rio", hootFilepath: str = "") -> None:
        self._name = canbus or "rio"

    def getName(self) -> str:
        return self._name

    @staticmethod
    def roboRIO(hootFilepath: str = "") -> "CANBus":
        return CANBus()


@fake(f"{CTRE}.configs", name="TalonFXConfigurator")
class Configurator(Fake):
    """Writes a device's settings and reads them (.../configs/TalonFXConfigurator.html)."""

    def __init__(self, device: Any) -> None:
        self._device = device

    def _part(self, configs: Record) -> tuple[dict[str, Any], str]:
        """Where the device stores a configuration: all of them, or a group of the whole one."""
        name = type(configs).__name__.removesuffix("Configs")
        groups = self._device._config._values
        if name in groups:
            return groups, name
        if type(configs) is type(self._device._config):
            return self._device.__dict__, "_config"
        raise WrongArgument(f"{type(self._device).__name__} has no {type(configs).__name__}")

    def apply(self, configs: Record, timeoutSeconds: float = 0.1) -> StatusCode:
        place, name = self._part(configs)
        place[name] = copy.deepcopy(configs)
        self._device._apply_settings()
        return OK

    def refresh(self, configs: Record, timeoutSeconds: float = 0.1) -> StatusCode:
        place, name = self._part(configs)
        configs._values = copy.deepcopy(place[name]._values)
        return OK


class ParentDevice(Device):
    """A device on a CAN bus (.../phoenix6/hardware/ParentDevice.html).

    ``_config``: its settings; ``_offset``: [rot] by which somebody moved its position.
    """

    fake_others = frozenset(TABLES["others"]["ParentDevice"].split())
    _kind = ""
    _offset: Any = 0.0

    def __init__(self, deviceId: int, canbus: str | CANBus = "rio") -> None:
        bus = canbus._name if isinstance(canbus, CANBus) else canbus or "rio"
        self._register_port("CAN", bus, name_port(deviceId), self._kind)
        self._id = deviceId
        self._signals: dict[str, StatusSignal] = {}
        names = (one.__name__ for one in type(self).__mro__ if one.__name__ in TABLES["devices"])
        self._config = copy.deepcopy(DEFAULTS[f"{next(names)}Configuration"])
        if WORLD.stored.get(deviceId, {}).get("inverted"):
            self._set_inverted(inverted=True)
        self._apply_settings()

    def __getattr__(self, name: str) -> Any:
        if "Fault" in name or name.startswith("getDifferential"):
            return Unknown(name)
        return super().__getattr__(name)

    def _set_inverted(self, *, inverted: bool) -> None:
        """Store the direction."""

    def _apply_settings(self) -> None:
        """Take over the settings."""

    def _setting(self, group: str, field: str) -> Any:
        return self._config._values[group]._values[field]

    def _read_turns(self) -> tuple[Any, Any]:
        """Position [rot], without the offset that the program set, and velocity [rot/s]."""
        return 0.0, 0.0

    def _measure_signal(self, name: str) -> Any:
        position, velocity = self._read_turns()
        known = {"getPosition": position + self._offset, "getVelocity": velocity}
        return known.get(name, Unknown(f"{type(self).__name__}.{name}()"))

    def getDeviceID(self) -> int:
        return self._id

    def getConfigurator(self) -> Configurator:
        return Configurator(self)

    def setPosition(self, newValue: float | Angle, timeoutSeconds: float = 0.1) -> StatusCode:
        self._offset = to_number(newValue) - self._read_turns()[0]
        return OK

    def isConnected(self, *_seconds: Any) -> bool:
        return True


_device = functools.partial(fake, f"{CTRE}.hardware", "phoenix6.hardware", complete=True)


@_device()
class TalonFX(ParentDevice, VendorMotor):
    """A motor controller inside a motor (.../phoenix6/hardware/TalonFX.html).

    ``_request``: the control request that it runs, None after ``set`` and ``setVoltage``.
    """

    _kind = "Talon"
    _feedback = "Feedback"
    _request: Record | None = None

    def _set_inverted(self, *, inverted: bool) -> None:
        directions = list(type(DEFAULTS["InvertedValue"]))
        self._config._values["MotorOutput"].Inverted = directions[inverted]
        self._apply_settings()

    def _apply_settings(self) -> None:
        self._inverted = self._setting("MotorOutput", "Inverted") != DEFAULTS["InvertedValue"]
        limits = [self._setting("Voltage", f"Peak{one}Voltage") for one in ("Forward", "Reverse")]
        self._peak = (limits[0], -limits[1])

    def _remote(self) -> Any:
        """The ID of the CANcoder that it measures with, or None."""
        source = self._setting(self._feedback, f"{self._feedback}SensorSource")
        remote = "CANcoder" in getattr(source, "name", "")
        return self._setting(self._feedback, "FeedbackRemoteSensorID") if remote else None

    @property
    def _gearing(self) -> Any:
        """Rotations of the rotor for one that is reported."""
        ratio = self._setting(self._feedback, "SensorToMechanismRatio") or 1.0
        if self._remote() is not None:
            ratio = ratio * (self._setting(self._feedback, "RotorToSensorRatio") or 1.0)
        return ratio

    def _read_turns(self) -> tuple[Any, Any]:
        ratio = self._gearing
        position, velocity = self._read_rotor()
        return position / ratio, velocity / ratio

    def _measure_signal(self, name: str) -> Any:
        position, velocity = self._read_rotor()
        known = {
            "getRotorPosition": position,
            "getRotorVelocity": velocity,
            "getMotorVoltage": self._applied,
            "getDutyCycle": self._applied / WORLD.battery,
            "getSupplyVoltage": WORLD.battery,
        }
        return known[name] if name in known else super()._measure_signal(name)

    def _fix_voltage(self, share: float = 1.0) -> None:
        kind = "Voltage" if self._command.kind == "voltage" else "DutyCycle"
        self._ramp = self._setting("OpenLoopRamps", f"{kind}OpenLoopRampPeriod")
        super()._fix_voltage(share)
        if not isinstance(self._applied, Unknown) and self._is_limited():
            self._applied = 0.0

    def _is_limited(self) -> bool:
        side, sign = ("Forward", 1) if self._applied > 0 else ("Reverse", -1)
        request = self._request._values if self._request else {}
        if request.get(f"Limit{side}Motion"):
            return True
        enabled = self._setting("SoftwareLimitSwitch", f"{side}SoftLimitEnable")
        limit = self._setting("SoftwareLimitSwitch", f"{side}SoftLimitThreshold")
        past = sign * (self._read_turns()[0] + self._offset - limit) >= 0
        return enabled and past and not request.get("IgnoreSoftwareLimits")

    def _apply_request(
        self, kind: str, value: Any, method: str, request: Record | None = None
    ) -> None:
        self._request = request
        if kind == "duty":
            ends = [f"Peak{one}DutyCycle" for one in ("Reverse", "Forward")]
            value = clamp(value, *(self._setting("MotorOutput", one) for one in ends))
        self._store_command(kind, value, method)

    def set(self, speed: float) -> None:
        self._apply_request("duty", speed, "set")

    def setVoltage(self, volts: float | Voltage) -> None:  # a measure until 2024
        self._apply_request("voltage", to_volts(volts), "setVoltage")

    def get(self) -> float:
        return self._applied / WORLD.battery

    def stopMotor(self) -> None:
        self._apply_request("neutral", 0.0, "stopMotor")

    def setControl(self, request: Record) -> StatusCode:
        call = "setControl" if WORLD.language == "java" else "set_control"
        if isinstance(request, Unknown):
            self._apply_request("closed-loop", 0.0, call)
            return OK
        values, name = request._values, type(request).__name__
        self._apply_request(
            request._kind, values.get("Output", 0.0), f"{call}({name})", copy.deepcopy(request)
        )
        if request._kind == "follow":
            self._leader = (*self._port[:2], name_port(values["LeaderID"]), self._kind)
            alignment = values.get("MotorAlignment")
            self._opposed = alignment is True or getattr(alignment, "name", "") == "Opposed"
            self._strict = name == "StrictFollower"
        return OK

    def setInverted(self, isInverted: bool) -> StatusCode:
        self._set_inverted(inverted=isInverted)
        return OK

    def getInverted(self) -> bool:
        return self._inverted

    disable = stopMotor


@_device()
class TalonFXS(TalonFX):
    """A motor controller for a brushless motor of any vendor (.../hardware/TalonFXS.html)."""

    _feedback = "ExternalFeedback"


@_device()
class CANcoder(ParentDevice):
    """A magnetic encoder (.../phoenix6/hardware/CANcoder.html).

    ``_turned_by``: the motor that measures with it; its rotor turns the bench's shaft.
    """

    _kind = "CANcoder"

    @property
    def _turned_by(self) -> TalonFX | None:
        motors = (one for one in WORLD.devices if isinstance(one, TalonFX))
        mine = (
            one for one in motors if one._port[1] == self._port[1] and one._remote() == self._id
        )
        return next(mine, None)

    def _read_turns(self) -> tuple[Any, Any]:
        motor = self._turned_by
        ratio = motor._setting(motor._feedback, "RotorToSensorRatio") if motor else 1.0
        turned = (
            self._setting("MagnetSensor", "SensorDirection") != DEFAULTS["SensorDirectionValue"]
        )
        ratio = -ratio if turned else ratio
        offset = self._setting("MagnetSensor", "MagnetOffset")
        return self._shaft.position / ratio + offset, self._shaft.velocity / ratio

    def _measure_signal(self, name: str) -> Any:
        if name == "getAbsolutePosition":
            below = 1.0 - self._setting("MagnetSensor", "AbsoluteSensorDiscontinuityPoint")
            return (self._read_turns()[0] + below) % 1.0 - below
        return super()._measure_signal(name)


@_device(complete=False)
class Pigeon2(ParentDevice):
    """A gyro that never turns (.../phoenix6/hardware/Pigeon2.html)."""

    _kind = "Pigeon2"

    def _measure_signal(self, name: str) -> float:
        return 0.0


def _add_signal(cls: type, name: str, unit: str) -> None:
    def get(self: ParentDevice, refresh: bool = True) -> StatusSignal:
        signal = self._signals.setdefault(name, StatusSignal(self, name, unit))
        return signal._read_value() if refresh else signal

    get.__qualname__ = f"{cls.__name__}.{name}"
    setattr(cls, name, checked(get))


for _class in (ParentDevice, TalonFX, TalonFXS, CANcoder, Pigeon2):
    _units = dict(TABLES["signals"][_class.__name__])
    for _name in _units.pop("without_unit", "").split():
        _add_signal(_class, _name, "")
    for _name, _unit in _units.items():
        _add_signal(_class, _name, _unit)


@fake(CTRE)
class Utils(Fake):
    """Time, and where the program runs (.../phoenix6/Utils.html)."""

    @staticmethod
    def getCurrentTimeSeconds() -> float:
        return WORLD.time

    @staticmethod
    def isSimulation() -> bool:
        return False


SWERVE = f"{CTRE}.swerve {CTRE}.mechanisms.swerve"


class _Constants(Fake):
    """Constants of a swerve drive or module by name; one that was not set is unknown."""

    def __init__(self, *_values: Any, **_named: Any) -> None:
        self._values: dict[str, Any] = {}

    def __getattr__(self, name: str) -> Any:
        if name.startswith("with"):
            return functools.partial(self._set, name.removeprefix("with"))
        return self.__dict__.get("_values", {}).get(name) or super().__getattr__(name)

    def _set(self, name: str, value: Any) -> "_Constants":
        self._values[name] = value
        return self


@fake(SWERVE, "phoenix6.swerve")
class SwerveModuleConstants(_Constants):
    """One module of a swerve drive (.../phoenix6/swerve/SwerveModuleConstants.html)."""

    ClosedLoopOutputType = Enum("ClosedLoopOutputType", "Voltage TorqueCurrentFOC")


@fake(SWERVE, "phoenix6.swerve")
class SwerveModuleConstantsFactory(_Constants):
    """What all modules have in common (.../swerve/SwerveModuleConstantsFactory.html)."""

    def createModuleConstants(
        self, steerMotorId: Any, driveMotorId: Any, encoderId: Any, *places: Any
    ) -> SwerveModuleConstants:
        made = SwerveModuleConstants()
        ids = {"SteerMotorId": steerMotorId, "DriveMotorId": driveMotorId, "EncoderId": encoderId}
        made._values = {**self._values, **ids}
        return made


@fake(SWERVE, "phoenix6.swerve")
class SwerveDrivetrainConstants(_Constants):
    """The bus and the gyro of a swerve drive (.../swerve/SwerveDrivetrainConstants.html)."""


@fake(SWERVE)
class SwerveRequest(Fake):
    """A command for a swerve drive (.../phoenix6/swerve/SwerveRequest.html)."""


for _name, _fields in TABLES["swerve_requests"].items():
    setattr(SwerveRequest, _name, make_record(_name, "swerve.requests", _fields))


class _Drive(Fake):
    """A request that moves the wheels by closed loops: its settings do not matter here."""

    def __getattr__(self, name: str) -> Any:  # whatever the member is
        return (lambda *_values: self) if name.startswith("with") else super().__getattr__(name)


for _name in TABLES["swerve_drives"]["names"].split():
    _class = type(Fake)(_name, (_Drive,), {"__doc__": "A request."})
    setattr(SwerveRequest, _name, fake("", "phoenix6.swerve.requests")(_class))


@fake(SWERVE, "phoenix6.swerve")
class SwerveDrivetrain(VendorMotor):
    """All motors of a swerve drive as one (.../phoenix6/swerve/SwerveDrivetrain.html)."""

    def __init__(self, *_settings: Any, **_named: Any) -> None:
        self._register_port("CAN", "swerve")

    def setControl(self, request: Any) -> None:
        known = isinstance(request, Record)
        value = next(iter(request._values.values())) if known else 0.0
        call = "setControl" if WORLD.language == "java" else "set_control"
        name = type(request).__name__
        self._store_command("voltage" if known else "closed-loop", value, f"{call}({name})")
