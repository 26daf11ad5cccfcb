"""Phoenix 5 of CTRE (5.36): Talon SRX and Victor SPX, and the Talon FX of 2024.

Names are those of https://api.ctr-electronics.com/phoenix/stable/java/.
"""

from enum import Enum
from typing import Any

from grader.robotcode.library.base import TABLES, fake
from grader.robotcode.library.hardware import (
    MotorController,
    VendorMotor,
    clamp,
    name_port,
    to_volts,
)
from grader.robotcode.library.units import Voltage
from grader.robotcode.library.world import WORLD

CTRE = "com.ctre.phoenix.motorcontrol"
TICKS = {"TalonFX": 2048}  # per rotation; the others have an encoder of 4096
NOMINAL = 12.0  # [V] what voltage compensation takes for full, unless told otherwise
TENTHS = 10.0  # of a second: velocities count ticks per 100 ms
MADE: dict[str, Any] = {name: Enum(name, members) for name, members in TABLES["enums"].items()}
for _name, _enum in MADE.items():
    fake(CTRE, "phoenix5 ctre")(_enum)
    for _model in ("TalonSRX", "VictorSPX", "TalonFX"):
        fake(CTRE, "phoenix5 ctre", name=f"{_model}{_name}")(_enum)
ControlMode, InvertType = MADE["ControlMode"], MADE["InvertType"]


@fake(f"{CTRE}.can", "phoenix5 ctre")
class BaseMotorController(VendorMotor):
    """A motor controller on the CAN bus (.../motorcontrol/can/BaseMotorController.html)."""

    _nominal: Any = 0.0  # [V] of voltage compensation, 0 while it is off
    _saturation: Any = NOMINAL
    _ticks, _model = 4096, ""  # ticks per rotation of the motor; devices whose IDs must differ
    _offset: Any = 0.0  # [ticks] by which somebody moved the sensor's position

    def __init__(self, deviceNumber: int, canbus: str = "rio") -> None:
        self._register_port("CAN", canbus or "rio", name_port(deviceNumber), self._model)
        self._id, self._strict = deviceNumber, True
        stored = WORLD.stored.get(deviceNumber, {})
        self._inverted = stored.get("inverted", False)

    def _send_output(self, share: Any, method: str) -> None:
        share = clamp(share, -1.0, 1.0)
        if self._nominal:
            self._store_command("voltage", share * self._nominal, method)
        else:
            self._store_command("duty", share, method)

    def set(self, mode: Any, value: Any = None, *_demand: Any) -> None:
        if value is None:
            self._send_output(mode, "set")
        elif mode is ControlMode.PercentOutput:
            self._send_output(value, "set(PercentOutput)")
        elif mode is ControlMode.Follower:
            self._store_command("follow", 0.0, "set(Follower)")
            others = (one for one in WORLD.devices if isinstance(one, BaseMotorController))
            self._leader = next((one for one in others if one._id == value), None)
        else:
            kind = "neutral" if mode is ControlMode.Disabled else "closed-loop"
            self._store_command(kind, 0.0, f"set({getattr(mode, 'name', '')})")

    def follow(self, masterToFollow: "BaseMotorController", *_type: Any) -> None:
        self._store_command("follow", 0.0, "follow")
        self._leader = masterToFollow

    def setInverted(self, isInverted: bool | InvertType) -> None:
        follows = isInverted in {InvertType.FollowMaster, InvertType.OpposeMaster}
        self._strict, self._opposed = not follows, isInverted is InvertType.OpposeMaster
        self._inverted = isInverted is True or isInverted is InvertType.InvertMotorOutput

    def getInverted(self) -> bool:
        return self._inverted

    def configFactoryDefault(self, *_timeout: Any) -> None:
        self._nominal, self._saturation, self._ramp = 0.0, NOMINAL, 0.0

    def configVoltageCompSaturation(self, voltage: float, *_timeout: Any) -> None:
        self._saturation = voltage

    def enableVoltageCompensation(self, enable: bool) -> None:
        self._nominal = self._saturation if enable else 0.0

    def configOpenloopRamp(self, secondsFromNeutralToFull: float, *_timeout: Any) -> None:
        self._ramp = secondsFromNeutralToFull

    def getMotorOutputPercent(self) -> float:
        return self._applied / WORLD.battery

    def getMotorOutputVoltage(self) -> float:
        return self._applied

    def getBusVoltage(self) -> float:
        return WORLD.battery

    def getDeviceID(self) -> int:
        return self._id

    def getSelectedSensorPosition(self, *_pid: Any) -> float:
        return self._read_rotor()[0] * self._ticks + self._offset

    def getSelectedSensorVelocity(self, *_pid: Any) -> float:
        return self._read_rotor()[1] * self._ticks / TENTHS

    def setSelectedSensorPosition(self, sensorPos: float, *_pid: Any) -> None:
        self._offset = sensorPos - self._read_rotor()[0] * self._ticks


class WpiMotorController(MotorController, BaseMotorController):
    """The members that only the classes ``WPI_`` have (.../can/WPI_TalonSRX.html)."""

    def setVoltage(self, outputVolts: float | Voltage) -> None:
        self._send_output(to_volts(outputVolts) / WORLD.battery, "setVoltage")

    def stopMotor(self) -> None:
        self._store_command("neutral", 0.0, "stopMotor")

    def get(self) -> float:
        return self._command.value

    set, setInverted = BaseMotorController.set, BaseMotorController.setInverted
    getInverted, disable = BaseMotorController.getInverted, stopMotor


for _model in ("TalonSRX", "VictorSPX", "TalonFX"):
    for _base, _name in ((BaseMotorController, _model), (WpiMotorController, f"WPI_{_model}")):
        _members: dict[str, Any] = {
            "__doc__": f"(.../motorcontrol/can/{_name}.html)",
            "_model": _model,
        }
        _members["_ticks"] = TICKS.get(_model, 4096)
        fake(f"{CTRE}.can", "phoenix5 ctre")(type(_name, (_base,), _members))
