"""What a robot program says about its SysIdRoutine, the same for Java and RobotPy.

Every fact is three-valued. What the text decides is known; what it leaves out is the library's
default; what cannot be decided by reading (a value computed by a call, say) is unknown, and is
asked about, never guessed.
"""

from dataclasses import dataclass
from enum import Enum


class Certainty(Enum):
    """How certain a fact is."""

    STATED = "stated"  # written in the code, through constants and arithmetic where need be
    DEFAULT = "default"  # left out, or null: the library's own value holds
    UNKNOWN = "unknown"  # cannot be told without running the program


@dataclass(frozen=True)
class ConfigQuantity:
    """A number with a dimension, in SI: V/s for the ramp, V for the step, s for the timeout.

    Args:
        known: how it was come by.
        value: the number in SI; None when unknown.
        dimension: what the code gave: ``volts-per-second``, ``volts``, ``seconds``, ``number`` (no
            unit; only Python's plain floats are right that way), or ``other``; empty if unknown.
        text: the source text it was read from, for the learner: ``Volts.of(0.5).per(Second)``.
        line: line in the source, from 1; 0 if it is not there.
    """

    known: Certainty
    value: float | None = None
    dimension: str = ""
    text: str = ""
    line: int = 0


class Output(Enum):
    """The kind of command that a motor gets in the drive callback."""

    VOLTAGE = "voltage"  # setVoltage, setControl(VoltageOut), set_voltage
    DUTY = "duty"  # set(...), DutyCycleOut: a share of whatever the battery gives
    CLOSED_LOOP = "closed-loop"  # PID, VelocityVoltage, PositionVoltage, MotionMagic, setReference
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class DriveCall:
    """One command to one motor inside the drive callback.

    Args:
        motor: the variable that is commanded: ``m_leftLeader``.
        method: the call as written: ``setVoltage``.
        output: what kind of command it is.
        uses_parameter: whether the callback's voltage reaches the call; None if unknown.
        scaled: whether the voltage is changed on its way (``voltage.in(Volts) / 12``), a sign
            apart; None if unknown.
        negative: whether its sign is changed on its way.
        text: the call's source text.
        line: line in the source, from 1; 0 if it stands in another file.
        condition: the code that decides by the voltage, or by nothing, whether the call is reached;
            empty if none does.
    """

    motor: str
    method: str
    output: Output
    uses_parameter: bool | None
    scaled: bool | None
    text: str
    line: int
    negative: bool = False
    condition: str = ""


class Source(Enum):
    """Where a logged value comes from."""

    APPLIED = "applied"  # measured or reported by the motor controller
    COMMANDED = "commanded"  # the number that was asked for, e.g. a field set in the drive callback
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class LoggedSignal:
    """One value recorded in the log callback.

    Args:
        motor: the name given to ``log.motor(...)``; empty if it could not be read.
        signal: ``voltage``, ``position``, ``velocity``, ``acceleration``, ``current`` or ``other``.
        family: ``linear``, ``angular`` or empty where it does not apply or cannot be told.
        unit: the unit as written, ``Meters``, ``RotationsPerSecond``; empty if none.
        source: where the value comes from.
        text: the call's source text, without what it is called on.
        line: line in the source, from 1; 0 if it stands in another file.
        device: the motor controller or encoder that reports it; empty if none or several do.
        type: that device's class.
        quantity: what the device reports: ``position``, ``velocity``, ``voltage``, ...
        native: the unit in which the device reports it, as ``readings.native_unit`` says.
        scale: what the device's number is multiplied with before the log gets it, the factor
            included that the device is set to; None if unknown.
        unsigned: whether its sign is lost on its way, as by ``Math.abs``.
        condition: as of a DriveCall.
    """

    motor: str
    signal: str
    family: str
    unit: str
    source: Source
    text: str
    line: int
    device: str = ""
    type: str = ""
    quantity: str = ""
    native: str = ""
    scale: float | None = None
    unsigned: bool = False
    condition: str = ""


@dataclass(frozen=True)
class ParseProblem:
    """A place in the code that cannot be parsed or compiled.

    Args:
        message: one sentence a student understands: ``a ')' is missing``.
        line: line in the source, from 1.
        meant: the name that was most likely meant, where one is misspelled; else empty.
    """

    message: str
    line: int
    meant: str = ""


@dataclass(frozen=True)
class RoutineFacts:
    """All that the text of a robot program says about its SysIdRoutine.

    Args:
        language: ``java`` or ``python``.
        class_name: the class that holds the routine; empty if none was found.
        is_subsystem: whether that class is a Subsystem.
        routine_line: where the SysIdRoutine is made; 0 if it is not.
        ramp, step, timeout: the Config's three numbers.
        motors: motor controller objects the class owns, without those set to follow another.
        drive_found, log_found: whether each callback was found (``null`` is not one).
        drive: the commands in the drive callback, followed through methods of the same class.
        logged: the values recorded in the log callback, followed likewise.
        log_is_null: the log callback is explicitly null/None (vendors' own loggers do that).
        subsystem_passed: whether the Mechanism gets ``this``/``self``; None if unknown.
        config_argument, mechanism_argument: positions of the two in the constructor call (0 and 1
            when right), -1 if absent.
        routine_lost: line where the field that holds the routine is set to null after that; 0 if
            it is not.
        problems: syntax errors; when there are any, the other facts may be incomplete.
        geared: motors that get a configuration, where one has a sensor-to-mechanism ratio.
        inverted: motors that the code sets to turn the other way round; ``*`` is one that cannot
            be told apart.
        impossible_numbers: devices that are made with what can be no port and no CAN ID.
        same_numbers: pairs of devices that are made with the same port or CAN ID.
        devices: the class of every motor controller and encoder the class owns, by its name.
        constants: the numbers among the class's fields, by their name.
        compile_errors: what keeps the file from being compiled, as far as text can tell.
        in_periodic: the commands that periodic() gives in every loop, besides the callback's.
        unread: where the callbacks lead to code that is not in these files, or too deep to
            follow: what is missing in ``drive`` or ``logged`` may be there.
    """

    language: str
    class_name: str = ""
    is_subsystem: bool = False
    routine_line: int = 0
    ramp: ConfigQuantity = ConfigQuantity(Certainty.UNKNOWN)
    step: ConfigQuantity = ConfigQuantity(Certainty.UNKNOWN)
    timeout: ConfigQuantity = ConfigQuantity(Certainty.UNKNOWN)
    motors: tuple[str, ...] = ()
    drive_found: bool = False
    log_found: bool = False
    drive: tuple[DriveCall, ...] = ()
    logged: tuple[LoggedSignal, ...] = ()
    log_is_null: bool = False
    subsystem_passed: bool | None = None
    config_argument: int = -1
    mechanism_argument: int = -1
    routine_lost: int = 0
    problems: tuple[ParseProblem, ...] = ()
    unread: tuple[ParseProblem, ...] = ()
    compile_errors: tuple[ParseProblem, ...] = ()
    in_periodic: tuple[DriveCall, ...] = ()
    inverted: frozenset[str] = frozenset()
    geared: frozenset[str] = frozenset()
    impossible_numbers: tuple[tuple[str, float], ...] = ()
    same_numbers: tuple[tuple[str, str], ...] = ()
    devices: tuple[tuple[str, str], ...] = ()
    constants: tuple[tuple[str, float], ...] = ()
