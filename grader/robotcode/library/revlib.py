"""REVLib: SPARK MAX and SPARK Flex of 2025 and 2026, and CANSparkMax of 2024.

Names are those of https://codedocs.revrobotics.com/java/com/revrobotics/spark/, which
``revlib.toml`` lists. A configuration holds what its setters were given; a SPARK takes it over in
``configure``, either on top of what it had, or after it has gone back to the defaults.
"""

import tomllib
from enum import Enum
from pathlib import Path
from typing import Any, ClassVar

from grader.robotcode.library.base import Fake, Unknown, WrongArgument, accepts, describe, fake
from grader.robotcode.library.devices import Device
from grader.robotcode.library.hardware import (
    MotorController,
    VendorMotor,
    clamp,
    name_port,
    to_volts,
)
from grader.robotcode.library.units import Voltage
from grader.robotcode.library.world import GEARING, WORLD

TABLES = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
REV = "com.revrobotics"
SPARK = f"{REV} {REV}.spark"
MINUTE = 60.0  # [s]
OFF = {"FollowerMode": "follow", "VoltageCompensation": "voltageCompensation"}
KINDS: dict[str, Any] = {"b": bool, "f": float, "i": int, "x": Any}
ENUMS: dict[str, Any] = {
    name: Enum(name, {one: place for place, one in enumerate(members.split())})
    for name, members in TABLES["enums"].items()
}
for _name, _enum in ENUMS.items():
    fake(f"{SPARK} {REV}.spark.config", "rev")(_enum)
OK = ENUMS["REVLibError"].kOk


class BaseConfig(Fake):
    """Setters that store their arguments under their name (.../config/BaseConfig.html)."""

    _parts: ClassVar[dict[str, type]] = {}  # attribute -> class of the configuration in it
    _family = ""  # name of the configurations that it can apply

    def __init__(self) -> None:
        self._given: dict[str, tuple[Any, ...]] = {}
        for name, cls in self._parts.items():
            setattr(self, name, cls())

    def _flat(self) -> dict[str, tuple[Any, ...]]:
        """All settings, those of the parts included: ``encoder.inverted``."""
        inner = {
            f"{part}.{name}": values
            for part in self._parts
            for name, values in getattr(self, part)._flat().items()
        }
        return self._given | inner

    def apply(self, config: "BaseConfig") -> "BaseConfig":
        parts = [self, *(getattr(self, name) for name in self._parts)]
        for one in parts:
            if config._family == one._family:
                one._copy_settings(config)
                return self
        raise WrongArgument(f"{type(self).__name__} applies no {type(config).__name__}")

    def _copy_settings(self, config: "BaseConfig") -> None:
        self._given |= config._given
        for name in self._parts:
            getattr(self, name)._copy_settings(getattr(config, name))


def _add_setter(cls: type, name: str, kinds: str) -> None:
    def set_(self: BaseConfig, *values: Any, **named: Any) -> BaseConfig:
        values += (*named.values(),)
        fits = sum(kind.islower() for kind in kinds) <= len(values) <= len(kinds)
        for kind, value in zip(kinds, values, strict=False):
            fits = fits and (isinstance(value, Unknown) or accepts(KINDS[kind.lower()], value))
        if not fits:
            text = ", ".join(map(describe, values))
            raise WrongArgument(f"{cls.__name__}.{name} takes other arguments than ({text})")
        self._given[name] = values
        return self

    setattr(cls, name, set_)


CONFIGS: dict[str, type] = {"BaseConfig": BaseConfig}
for _name, _members in TABLES["configs"].items():
    _parts = {part: CONFIGS[kind] for part, kind in _members.items() if part != "methods"}
    _text = f"A configuration (.../spark/config/{_name}.html)."
    CONFIGS[_name] = type(
        _name, (BaseConfig,), {"_parts": _parts, "_family": _name, "__doc__": _text}
    )
    for _cell in _members["methods"].split():
        _add_setter(CONFIGS[_name], *_cell.split(":"))
for _name in ("SparkMaxConfig", "SparkFlexConfig"):
    CONFIGS[_name] = type(_name, (CONFIGS["SparkBaseConfig"],), {"__doc__": "Of one model."})
for _name, _class in CONFIGS.items():
    fake(f"{REV}.spark.config {REV}.config", "rev", complete=True, others="flatten signals")(_class)
MotorType, IdleMode, ControlType, ResetMode, PersistMode = (
    ENUMS[one] for one in ("MotorType", "IdleMode", "ControlType", "ResetMode", "PersistMode")
)
SparkBaseConfig = CONFIGS["SparkBaseConfig"]
SparkBaseConfig.IdleMode = IdleMode
CONFIGS["ClosedLoopConfig"].FeedbackSensor = ENUMS["FeedbackSensor"]  # until 2025


@fake(SPARK, "rev", complete=True, others=TABLES["other_members"]["encoder"])
class RelativeEncoder(Fake):
    """An encoder on the motor's shaft (.../revrobotics/RelativeEncoder.html)."""

    _offset: Any = 0.0  # [rot] by which somebody moved its position

    def __init__(self, spark: Any, part: str) -> None:
        self._spark, self._part = spark, part

    def _setting(self, name: str, default: Any) -> Any:
        return self._spark._setting(f"{self._part}.{name}", default)

    def _read_turns(self) -> tuple[Any, Any]:
        position, velocity = self._spark._read_rotor()
        return position, velocity * MINUTE

    def getPosition(self) -> float:
        turns = self._read_turns()[0] + self._offset
        return turns * self._setting("positionConversionFactor", 1.0)

    def getVelocity(self) -> float:
        return self._read_turns()[1] * self._setting("velocityConversionFactor", 1.0)

    def setPosition(self, position: float) -> Enum:
        turns = position / self._setting("positionConversionFactor", 1.0)
        self._offset = turns - self._read_turns()[0]
        return OK

    def setPositionConversionFactor(self, factor: float) -> Enum:
        self._spark._settings[f"{self._part}.positionConversionFactor"] = (factor,)
        return OK

    def setVelocityConversionFactor(self, factor: float) -> Enum:
        self._spark._settings[f"{self._part}.velocityConversionFactor"] = (factor,)
        return OK


@fake(SPARK, "rev", complete=True)
class AbsoluteEncoder(RelativeEncoder):
    """An encoder that knows where it is within a rotation (.../revrobotics/AbsoluteEncoder.html).

    It sits behind the gears of the mechanism.
    """

    def _read_turns(self) -> tuple[Any, Any]:
        shaft = self._spark._shaft
        sign = -1.0 if self._setting("inverted", False) else 1.0
        least = -0.5 if self._setting("zeroCentered", False) else 0.0
        turns = sign * shaft.position / GEARING - self._setting("zeroOffset", 0.0)
        return (turns - least) % 1.0 + least, sign * shaft.velocity / GEARING * MINUTE


RelativeEncoder.Type = ENUMS["EncoderType"]  # until 2024
AbsoluteEncoder.Type = ENUMS["AbsoluteEncoderType"]
for _name in ("SparkRelativeEncoder", "SparkMaxAlternateEncoder", "SparkFlexExternalEncoder"):
    fake(SPARK, "rev", name=_name, complete=True)(RelativeEncoder)
fake(SPARK, "rev", name="SparkAbsoluteEncoder", complete=True)(AbsoluteEncoder)


@fake(SPARK, "rev", complete=True, others=TABLES["other_members"]["controller"])
class SparkClosedLoopController(Fake):
    """The controller inside a SPARK (.../spark/SparkClosedLoopController.html)."""

    ArbFFUnits = ENUMS["ArbFFUnits"]

    def __init__(self, spark: Any) -> None:
        self._spark = spark

    def _store_command(self, call: str, value: Any, kind: Enum, more: tuple[Any, ...]) -> Enum:
        kinds = {ControlType.kVoltage: "voltage", ControlType.kDutyCycle: "duty"}
        extra = more[1] if len(more) > 1 and kind is ControlType.kVoltage else 0.0
        name = kind.name if isinstance(kind, Enum) else ""
        self._spark._send_output(kinds.get(kind, "closed-loop"), value + extra, f"{call}({name})")
        return OK

    def setSetpoint(self, setpoint: float, ctrl: ControlType, *more: Any) -> Enum:
        return self._store_command("setSetpoint", setpoint, ctrl, more)

    def setReference(self, value: float, ctrl: ControlType, *more: Any) -> Enum:
        return self._store_command("setReference", value, ctrl, more)


fake(SPARK, "rev", name="SparkPIDController", complete=True)(SparkClosedLoopController)


@fake(SPARK, "rev", complete=True, others=TABLES["other_members"]["spark"])
class SparkBase(MotorController, VendorMotor):
    """A SPARK (.../spark/SparkBase.html).

    ``_settings``: what its configuration was given. A SPARK that follows ignores other commands.
    """

    MotorType, ControlType, IdleMode = MotorType, ControlType, IdleMode
    ResetMode, PersistMode = ResetMode, PersistMode

    def __init__(self, deviceId: int, type: MotorType) -> None:
        self._register_port("CAN", "rio", name_port(deviceId), "Spark")
        self._id = deviceId
        self._parts: dict[str, Any] = {}
        self._speed: Any = 0.0
        stored = WORLD.stored.get(deviceId, {})
        self._settings: dict[str, Any] = {name: (value,) for name, value in stored.items()}
        self._apply_settings()

    def _setting(self, name: str, default: Any) -> Any:
        values = self._settings.get(name)
        return values[0] if values else default

    def _apply_settings(self) -> None:
        self._inverted = self._setting("inverted", False)
        self._ramp = self._setting("openLoopRampRate", 0.0)
        follow = self._settings.get("follow")
        if follow:
            leader, *invert = follow
            self._store_command("follow", 0.0, "follow")
            is_spark = isinstance(leader, Device)
            self._leader = leader if is_spark else ("CAN", "rio", name_port(leader), "Spark")
            self._opposed = bool(invert and invert[0])
        else:
            self._leader = None

    def _send_output(self, kind: str, value: Any, method: str) -> None:
        if self._leader is not None:
            return
        if kind == "duty":
            nominal = self._setting("voltageCompensation", 0.0)
            value = clamp(value, -1.0, 1.0)
            kind, value = ("voltage", value * nominal) if nominal else (kind, value)
        self._store_command(kind, value, method)

    def _part(self, part: str, cls: type = RelativeEncoder) -> Any:
        return self._parts.setdefault(part, cls(self, part))

    def set(self, speed: float) -> None:
        self._speed = speed
        self._send_output("duty", speed, "set")

    def setVoltage(self, outputVolts: float | Voltage) -> None:
        self._send_output("voltage", to_volts(outputVolts), "setVoltage")

    def stopMotor(self) -> None:
        self._speed = 0.0
        self._send_output("neutral", 0.0, "stopMotor")

    def get(self) -> float:
        """The share that the motor gets: REV does not say whether a voltage changes it."""
        return self._applied / WORLD.battery

    def setInverted(self, isInverted: bool) -> None:
        self._settings["inverted"] = (isInverted,)
        self._inverted = isInverted

    def configure(
        self, config: SparkBaseConfig, resetMode: ResetMode, persistMode: PersistMode
    ) -> Enum:
        kept = {} if resetMode is ResetMode.kResetSafeParameters else self._settings
        self._settings = kept | config._flat()
        for setter in ("FollowerMode", "VoltageCompensation"):
            if self._settings.pop(f"disable{setter}", None) is not None:
                self._settings.pop(OFF[setter], None)
        self._apply_settings()
        return OK

    def getAppliedOutput(self) -> float:
        return self._applied / WORLD.battery

    def getBusVoltage(self) -> float:
        return WORLD.battery

    def getOutputCurrent(self) -> float:
        return Unknown("SparkBase.getOutputCurrent()")  # type: ignore[return-value]  # nobody knows it

    def getDeviceId(self) -> int:
        return self._id

    def isFollower(self) -> bool:
        return self._leader is not None

    getEncoder = lambda self, *_settings: self._part("encoder")
    getAlternateEncoder = lambda self, *_settings: self._part("alternateEncoder")
    getExternalEncoder = lambda self: self._part("externalEncoder")
    getAbsoluteEncoder = lambda self, *_settings: self._part("absoluteEncoder", AbsoluteEncoder)

    def getClosedLoopController(self) -> SparkClosedLoopController:
        return SparkClosedLoopController(self)

    disable, getPIDController = stopMotor, getClosedLoopController


@fake(REV, "rev", complete=True, others=TABLES["other_members"]["spark_2024"])
class CANSparkBase(SparkBase):
    """A SPARK of 2024, whose settings have setters of their own (.../CANSparkBase.html)."""

    def _store(self, name: str, *values: Any) -> Enum:
        self._settings[name] = values
        self._apply_settings()
        return OK

    def restoreFactoryDefaults(self, persist: bool = False) -> Enum:
        self._settings = {}
        self._apply_settings()
        return OK

    def enableVoltageCompensation(self, nominalVoltage: float) -> Enum:
        return self._store("voltageCompensation", nominalVoltage)

    def disableVoltageCompensation(self) -> Enum:
        return self._store("voltageCompensation", 0.0)

    def setOpenLoopRampRate(self, rate: float) -> Enum:
        return self._store("openLoopRampRate", rate)

    def follow(self, leader: SparkBase, invert: bool = False) -> Enum:
        return self._store("follow", leader, invert)
