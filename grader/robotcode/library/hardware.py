"""Motor controllers on PWM ports, drive classes, encoders and gyros of WPILib.

Also what the motor controllers of all vendors share: ramps, followers, and numbers from measures.
"""

from typing import Any

from grader.robotcode.library.base import Fake, Unknown, WrongArgument, fake
from grader.robotcode.library.devices import Device, Motor
from grader.robotcode.library.units import CONSTANTS, Voltage
from grader.robotcode.library.world import PERIOD, WORLD

NOMINAL = 12.0  # [V] what a ramp's time is counted to
PULSES = 2048  # per rotation of an encoder, unless the bench says otherwise
EDGES = 4  # of one pulse of an encoder with two channels
MOTORS = "edu.wpi.first.wpilibj.motorcontrol org.wpilib.hardware.motor"
ENCODERS = "edu.wpi.first.wpilibj org.wpilib.hardware.rotation"


def to_volts(value: Any) -> Any:
    """A voltage [V] given as a number or as a measure."""
    return value.in_(CONSTANTS["Volts"]) if isinstance(value, Voltage) else value


def clamp(value: Any, low: float, high: float) -> Any:
    """A number within limits; an unknown value stays unknown."""
    return value if isinstance(value, Unknown) else max(low, min(high, value))


def name_port(port: Any) -> Any:
    """The number of a port, or of the port of a device.

    A number that nobody knows is a port of its own, under the name that the code has for it.
    """
    if isinstance(port, Unknown):
        return f"{port.unknown_text} ({len(WORLD.devices)})"
    return port._port[-1] if isinstance(port, Device) else port


class VendorMotor(Motor):
    """A motor controller with a ramp, which may follow another one.

    ``_ramp``: time [s] from zero to all of the voltage, 0 for at once. ``_strict``: whether a
    follower takes the number of its leader and turns by its own inversion; otherwise it turns as
    the shaft of its leader does.
    """

    def _register_port(self, *port: Any) -> None:
        super()._register_port(*port)
        self._ramp: Any = 0.0
        self._strict = False

    def _fix_voltage(self, share: float = 1.0) -> None:
        before = self._applied
        super()._fix_voltage(share)
        known = not any(isinstance(one, Unknown) for one in (before, self._applied, self._ramp))
        if known and self._ramp > 0 and WORLD.enabled and self._command.kind in {"voltage", "duty"}:
            step = NOMINAL / self._ramp * PERIOD
            self._applied = clamp(self._applied, before - step, before + step)

    def _copy_leader(self, leader: Motor) -> None:
        """Copy a leader's output; called in place of ``_fix_voltage``, after that of the leader."""
        turned = self._opposed != (not self._strict and leader._inverted != self._inverted)
        self._applied = -leader._applied if turned else leader._applied


@fake(f"{MOTORS} edu.wpi.first.wpilibj", "wpilib.interfaces")
class MotorController(Fake):
    """A motor controller of any vendor (allwpilib v2026, .../motorcontrol/MotorController.java)."""

    _inverted: bool = False

    def setVoltage(self, outputVolts: float | Voltage) -> None:
        self.set(to_volts(outputVolts) / WORLD.battery)

    def setInverted(self, isInverted: bool) -> None:
        self._inverted = isInverted

    def getInverted(self) -> bool:
        return self._inverted


@fake(MOTORS, "wpilib", complete=True)
class PWMMotorController(MotorController, VendorMotor):
    """A motor controller on a PWM port (allwpilib v2026, .../PWMMotorController.java)."""

    def __init__(self, channel: int) -> None:
        self._channel = channel
        self._followers: list[PWMMotorController] = []
        self._register_port("PWM", name_port(channel))

    def _send_output(self, kind: str, speed: Any, method: str) -> None:
        speed = clamp(speed, -1.0, 1.0)
        self._store_command(kind, speed, method)
        for follower in self._followers:
            follower._send_output(kind, -speed if self._inverted else speed, method)

    def set(self, speed: float) -> None:
        self._send_output("duty", speed, "set")

    def setThrottle(self, throttle: float) -> None:
        self._send_output("duty", throttle, "setThrottle")

    def setVoltage(self, outputVolts: float | Voltage) -> None:
        self._send_output("duty", to_volts(outputVolts) / WORLD.battery, "setVoltage")

    def stopMotor(self) -> None:
        self._send_output("neutral", 0.0, "stopMotor")

    def get(self) -> float:
        return self._command.value

    def getVoltage(self) -> float:
        return self._command.value * WORLD.battery

    def addFollower(self, follower: "PWMMotorController") -> None:
        self._followers.append(follower)

    def getChannel(self) -> int:
        return self._channel

    getThrottle = get
    disable = stopMotor


@fake(MOTORS, "wpilib", complete=True)
class MotorControllerGroup(MotorController):
    """Motors of one voltage (allwpilib v2026, .../motorcontrol/MotorControllerGroup.java)."""

    def __init__(self, *motors: Any) -> None:
        self._motors = [
            one for some in motors for one in (some if isinstance(some, list) else [some])
        ]
        self._speed: Any = 0.0

    def set(self, speed: float) -> None:
        self._speed = speed
        for motor in self._motors:
            motor.set(-speed if self._inverted else speed)

    def setVoltage(self, outputVolts: float | Voltage) -> None:
        volts = to_volts(outputVolts)
        for motor in self._motors:
            motor.setVoltage(-volts if self._inverted else volts)

    def stopMotor(self) -> None:
        self._speed = 0.0
        for motor in self._motors:
            motor.stopMotor()

    def get(self) -> float:
        return self._speed

    disable = stopMotor


@fake("edu.wpi.first.wpilibj.drive org.wpilib.drive", "wpilib.drive")
class DifferentialDrive(Fake):
    """A left and a right side, at unknown speeds (allwpilib, .../drive/DifferentialDrive.java)."""

    def __init__(self, leftMotor: Any, rightMotor: Any) -> None:  # motors or functions
        self._sides = (leftMotor, rightMotor)

    def _drive_sides(self, *_speeds: Any, **_settings: Any) -> None:
        for side in self._sides:
            command = side if callable(side) else side.set
            command(Unknown("the speed of the drive class"))

    def stopMotor(self) -> None:
        for side in self._sides:
            (side if callable(side) else side.set)(0.0)

    tankDrive = arcadeDrive = curvatureDrive = _drive_sides


@fake(ENCODERS, "wpilib", complete=True)
class Encoder(Device):
    """An encoder with two channels on DIO ports (allwpilib v2026, .../wpilibj/Encoder.java)."""

    _scale: Any = 1.0  # distance per pulse
    _zero = 0.0  # [rot] of the shaft, where the encoder reads 0
    _pulses_per_rotation = PULSES

    def __init__(self, channelA: Any, channelB: Any, *settings: Any, **named: Any) -> None:
        self._register_port("DIO", name_port(channelA), name_port(channelB))
        if channelA == channelB and isinstance(channelA, int):
            raise WrongArgument(f"Encoder: both of its channels are on port {channelA}")
        self._reversed = any(one is True for one in (*settings, named.get("reverseDirection")))

    def _count_pulses(self, rotations: float) -> float:
        return rotations * self._pulses_per_rotation * (-1 if self._reversed else 1)

    def get(self) -> int:
        return int(self._count_pulses(self._shaft.position - self._zero))

    def getRaw(self) -> int:
        return int(EDGES * self._count_pulses(self._shaft.position - self._zero))

    def getDistance(self) -> float:
        return self._count_pulses(self._shaft.position - self._zero) * self._scale

    def getRate(self) -> float:
        return self._count_pulses(self._shaft.velocity) * self._scale

    def reset(self) -> None:
        self._zero = self._shaft.position

    def setReverseDirection(self, reverseDirection: bool) -> None:
        self._reversed = reverseDirection

    def setDistancePerPulse(self, distancePerPulse: float) -> None:
        self._scale = distancePerPulse


@fake(ENCODERS, "wpilib")
class DutyCycleEncoder(Device):
    """An absolute encoder on a DIO port (allwpilib v2026, .../wpilibj/DutyCycleEncoder.java)."""

    _kind = "DIO"

    def __init__(self, channel: Any, fullRange: float = 1.0, expectedZero: float = 0.0) -> None:
        self._register_port(self._kind, name_port(channel))
        self._range, self._expected = fullRange, expectedZero
        self._inverted = False

    def get(self) -> float:
        value = (self._shaft.position * self._range - self._expected) % self._range
        return self._range - value if self._inverted else value

    def isConnected(self) -> bool:
        return True

    def setInverted(self, inverted: bool) -> None:
        self._inverted = inverted


@fake(ENCODERS, "wpilib")
class AnalogEncoder(DutyCycleEncoder):
    """An absolute encoder on an analog port (allwpilib v2026, .../wpilibj/AnalogEncoder.java)."""

    _kind = "Analog"


@fake("com.studica.frc com.kauailabs.navx.frc", "navx", name="AHRS")
class Gyro(Fake):
    """A gyro that never turns."""

    def getAngle(self, *_axis: Any) -> float:
        return 0.0

    getYaw = getRate = getAngle
