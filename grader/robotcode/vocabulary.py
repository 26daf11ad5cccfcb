"""The words of the season: units, motor controllers, methods and the library's defaults.

WPILib and the vendors rename things from year to year. A new name is one entry here. Words are kept
in Java's spelling; ``plain`` brings ``set_voltage`` to ``setVoltage``, and ``constant`` brings
``kForward``, ``FORWARD`` and ``Forward`` to ``forward``, so that RobotPy's names of 2026 and those
of 2027 need no table of their own. Packages (``edu.wpi.first``, ``org.wpilib``) play no part.
"""

import re
from dataclasses import dataclass

from grader.robotcode.facts import Certainty, ConfigQuantity, Output

# What Config uses where it is given nothing, by season: ramp [V/s], step [V], timeout [s]. WPILib
# 2024 to 2026; those of 2027 as on the development branch, where a smaller step is under discussion
# (allwpilib #7794).
SEASON = 2026
CONFIG_DEFAULTS = {2026: (1.0, 7.0, 10.0), 2027: (1.0, 7.0, 10.0)}


def find_config_defaults(season: int) -> dict[str, ConfigQuantity]:
    """WPILib's own ramp, step and timeout in a season; 0 or an unknown one takes the current."""
    ramp, step, timeout = CONFIG_DEFAULTS.get(season, CONFIG_DEFAULTS[SEASON])
    return {
        "ramp": ConfigQuantity(Certainty.DEFAULT, ramp, "volts-per-second"),
        "step": ConfigQuantity(Certainty.DEFAULT, step, "volts"),
        "timeout": ConfigQuantity(Certainty.DEFAULT, timeout, "seconds"),
    }


DEFAULTS = find_config_defaults(SEASON)
NAMED_DEFAULTS = {  # Java's constants of Config, and what they hold
    "DEFAULT_RAMP_RATE": "ramp",
    "DEFAULT_STEP_VOLTAGE": "step",
    "DEFAULT_TIMEOUT": "timeout",
}

# Commands v3 (Java, 2027): its packages, and what its SysIdRoutine calls its parts.
COMMANDS_V3 = ("org.wpilib.command3.", "org.wpilib.commands3.")
CONFIG_FACTORIES = frozenset({"useDataLog", "defaults"})  # static methods that make a Config
MECHANISMS = frozenset({"Mechanism", "SysIdMechanism"})  # what makes a SysIdRoutine's mechanism

# Keyword arguments, in order of position.
CONFIG = ("rampRate", "stepVoltage", "timeout", "recordState")
MECHANISM = ("drive", "log", "subsystem", "name")
ROUTINE = ("config", "mechanism")

SUBSYSTEMS = frozenset(
    {
        "Subsystem",
        "SubsystemBase",
        "PIDSubsystem",
        "ProfiledPIDSubsystem",
        "TrapezoidProfileSubsystem",
        "Mechanism",  # of Commands v3
    }
)

DIRECTIONS = frozenset({"forward", "reverse"})  # as `constant` gives them


@dataclass(frozen=True)
class JavaUnit:
    """A unit of Java's Units class.

    Args:
        si: how much one of it is in SI; 1 for those that no Config holds.
        volts, seconds: the powers of volt and second in it.
        family: ``linear``, ``angular``, or empty where neither applies.
        other: whether there is more in it than volts and seconds.
    """

    si: float
    volts: int = 0
    seconds: int = 0
    family: str = ""
    other: bool = False


def _with_singular(name: str, unit: JavaUnit) -> dict[str, JavaUnit]:
    """A unit under its plural and its singular name."""
    singular = {"Feet": "Foot", "Inches": "Inch"}.get(name, name.removesuffix("s"))
    return {name: unit, singular: unit}


def _units() -> dict[str, JavaUnit]:
    units: dict[str, JavaUnit] = {}
    for prefix, size in (("", 1.0), ("Milli", 1e-3), ("Micro", 1e-6), ("Kilo", 1e3)):
        units |= _with_singular((prefix + "volts").capitalize(), JavaUnit(size, volts=1))
        units |= _with_singular((prefix + "seconds").capitalize(), JavaUnit(size, seconds=1))
        units |= _with_singular((prefix + "amps").capitalize(), JavaUnit(size, other=True))
    units |= _with_singular("Minutes", JavaUnit(60.0, seconds=1))
    linear = ("Meters", "Millimeters", "Centimeters", "Feet", "Inches")
    angular = ("Rotations", "Revolutions", "Radians", "Degrees")
    for family, names in (("linear", linear), ("angular", angular)):
        length = JavaUnit(1.0, family=family, other=True)
        for name in names:
            units |= _with_singular(name, length)
            units[f"{name}PerSecond"] = units[f"{name}PerSecondPerSecond"] = length
    units["RPM"] = JavaUnit(1.0, family="angular", other=True)
    return units


UNITS = _units()

# Python's wpimath.units: calling one leaves a float as it is, but for those that convert.
PYTHON_UNITS = {
    "volts": 1.0,
    "millivolts": 1.0,
    "volts_per_second": 1.0,
    "units_per_second": 1.0,
    "seconds": 1.0,
    "milliseconds": 1.0,
    "minutes": 1.0,
    "millisecondsToSeconds": 1e-3,
    "secondsToMilliseconds": 1e3,
    "float": 1.0,
}

_MOTORS = re.compile(
    r"TalonFXS?|TalonSRX|VictorSPX|BaseTalon|CommonTalon|CoreTalonFXS?|WPI_\w+"
    r"|(CAN)?Spark(Max|Flex|Base|LowLevel)|ThriftyNova|(CAN)?Venom"
    r"|PWM(?!Sim)\w+|Spark|Talon|Victor(SP)?|Jaguar|DMC60|SD540|Koors40|NidecBrushless"
    r"|\w*MotorController"
)
GROUPS = frozenset({"MotorControllerGroup", "SpeedControllerGroup"})  # all get the same command
DRIVES = frozenset({"DifferentialDrive", "MecanumDrive", "KilloughDrive"})  # all get duty cycles


def is_motor(type_: str) -> bool:
    """Whether a type is a motor controller, or holds some: ``TalonFX[]``, ``List<SparkMax>``."""
    return any(_MOTORS.fullmatch(word) for word in re.findall(r"\w+", type_))


def spell_as_java(name: str) -> str:
    """A method's name in Java's spelling: ``set_voltage`` is ``setVoltage``."""
    first, *rest = name.split("_")
    if not first or not name.islower() or not rest:
        return name
    return first + "".join(word.capitalize() for word in rest)


def normalize_enum_constant(name: str) -> str:
    """An enum constant in the form of every season: ``dutycycle`` of ``kDutyCycle``."""
    bare = name[1:] if re.match(r"k[A-Z]", name) else name
    return bare.replace("_", "").lower()


# Commands a motor (or whatever stands for one) is given, by method.
COMMANDS = {
    "setVoltage": Output.VOLTAGE,
    "setVoltageOutput": Output.VOLTAGE,
    "setPower": Output.DUTY,
    "setDutyCycle": Output.DUTY,
    "setThrottle": Output.DUTY,  # WPILib 2027's name of set
    "setPercentOutput": Output.DUTY,
    "tankDrive": Output.DUTY,
    "arcadeDrive": Output.DUTY,
    "curvatureDrive": Output.DUTY,
    "driveCartesian": Output.DUTY,
}
BY_MODE = frozenset({"set", "setReference", "setSetpoint"})  # ... where a further argument decides
STOPS = frozenset({"stopMotor", "disable", "neutralOutput"})  # ... that leave it without voltage
BY_REQUEST = frozenset({"setControl"})  # ... where the request that is handed over decides

# That further argument: ControlType of REV, ControlMode of Phoenix 5. Without one, WITHOUT_MODE.
MODES = {
    "voltage": Output.VOLTAGE,
    "dutycycle": Output.DUTY,
    "percentoutput": Output.DUTY,
    "velocity": Output.CLOSED_LOOP,
    "position": Output.CLOSED_LOOP,
    "motionmagic": Output.CLOSED_LOOP,
    "motionprofile": Output.CLOSED_LOOP,
    "smartmotion": Output.CLOSED_LOOP,
    "smartvelocity": Output.CLOSED_LOOP,
    "maxmotionpositioncontrol": Output.CLOSED_LOOP,
    "maxmotionvelocitycontrol": Output.CLOSED_LOOP,
    "current": Output.CLOSED_LOOP,
}
WITHOUT_MODE = {
    "set": Output.DUTY,
    "setReference": Output.CLOSED_LOOP,
    "setSetpoint": Output.CLOSED_LOOP,
}

_REQUESTS = (  # Phoenix 6 control requests; the first that fits
    (re.compile(r"(Differential)?VoltageOut|SysIdSwerve\w+"), Output.VOLTAGE),
    (re.compile(r"(Differential)?DutyCycleOut"), Output.DUTY),
    (
        re.compile(
            r"(Diff_|Differential|Dynamic)*(MotionMagic|Position|Velocity)\w*|TorqueCurrent\w*"
        ),
        Output.CLOSED_LOOP,
    ),
)
NEUTRAL = frozenset({"NeutralOut", "CoastOut", "StaticBrake", "Follower", "StrictFollower"})
FOLLOWERS = frozenset(
    {"Follower", "StrictFollower", "DifferentialFollower", "DifferentialStrictFollower"}
)


def find_request_output(type_: str) -> Output | None:
    """The output that a control request commands; None for a follower or a brake."""
    if type_ in NEUTRAL | FOLLOWERS:
        return None
    return next((out for form, out in _REQUESTS if form.fullmatch(type_)), Output.UNKNOWN)


# How the voltage goes through a call.
SAME = frozenset(  # the call gives back what it was called on
    {
        "magnitude",
        "baseUnitMagnitude",
        "copy",
        "mutableCopy",
        "getValue",
        "getValueAsDouble",
        "refresh",
        "doubleValue",
        "stream",
    }
)
ARGUMENT = frozenset({"float", "double", "valueOf", "volts"})  # the call gives back its argument
LIMITS = frozenset({"clamp", "min", "max"})  # ... unless it is beyond a bound
NEVER_REACHED = 6.0  # [V] 0.5 V/s for 10 s ends at 5 V, and a step is lower
UNSIGNED = frozenset({"abs", "fabs"})
OPPOSITE = frozenset({"unaryMinus", "negate"})
TIMES = frozenset({"times", "mutTimes"})
OVER = frozenset({"div", "divide", "mutDivide"})
AMOUNTS = frozenset({"of", "ofBaseUnits", "mutable"})  # Volts.of(x)
REPLACES = frozenset({"mutReplace", "mutSetMagnitude", "mutSetBaseUnitMagnitude"})
CALCULATES = frozenset({"calculate", "calculateWithVelocities"})
CONTROLLERS = re.compile(r".*(PID|BangBang|LinearQuadratic|LinearSystemLoop).*", re.IGNORECASE)
LOOPS = frozenset({"forEach"})
RUNS = frozenset({"accept", "apply", "run", "call"})  # run a lambda that a variable holds
COLLECTIONS = frozenset({"List", "Set", "Arrays", "Stream"})  # List.of(left, right)
STAND_INS = re.compile(r"(Sim|Simulated|Simulation|Replay|Mock|Fake|Noop)(?![a-z])")  # ModuleIOSim
SILENT = re.compile(  # methods that show or keep a value, and move nothing
    r"(get|is|has|with|mut|put|log|record|print|publish|append|report|add|info|equals|to)([A-Z]\w*)?"
    r"|println|printf|calculate\w*|abs|max|min|clamp|in|of|signum|copySign|format|times|div|divide"
)

# Where a logged value comes from, by the methods it is read with.
APPLIED_VOLTAGE = frozenset({"getMotorVoltage", "getMotorOutputVoltage", "getOutputVoltage"})
APPLIED_DUTY = frozenset(
    {
        "get",
        "getAppliedOutput",
        "getDutyCycle",
        "getThrottle",  # WPILib 2027's name of get
        "getMotorOutputPercent",
        "getPercentOutput",
    }
)
BUS_VOLTAGE = frozenset(
    {
        "getBatteryVoltage",
        "getMeasureBatteryVoltage",
        "getBusVoltage",
        "getSupplyVoltage",
        "getInputVoltage",
    }
)
# In which unit a device reports its position, and per second its velocity.
ROTATIONS = re.compile(r"(Core)?TalonFXS?|(Core)?CANcoder|(Core)?CANdi")  # Phoenix 6
SPARKS = re.compile(  # rotations and rpm, unless a conversion factor is set
    r"(CAN)?Spark(Max|Flex|Base|LowLevel)|RelativeEncoder|SparkRelativeEncoder"
    r"|AbsoluteEncoder|SparkAbsoluteEncoder|SparkMaxRelativeEncoder"
)
PULSES = re.compile(r"Encoder")  # WPILib's: pulses, until a distance per pulse is set
MEASURED = re.compile(  # position, velocity, acceleration and current of encoders and motors
    r"get\w*(Position|Velocity|Distance|Rate|Angle|Acceleration|Current|Speed)\w*|get"
)

# Methods of a MotorLog -> signal, and family where the method says it.
SIGNALS = {
    "voltage": ("voltage", ""),
    "current": ("current", ""),
    "linearPosition": ("position", "linear"),
    "linearVelocity": ("velocity", "linear"),
    "linearAcceleration": ("acceleration", "linear"),
    "angularPosition": ("position", "angular"),
    "angularVelocity": ("velocity", "angular"),
    "angularAcceleration": ("acceleration", "angular"),
    "position": ("position", ""),
    "velocity": ("velocity", ""),
    "acceleration": ("acceleration", ""),
    "value": ("other", ""),
}

# RobotPy wrote all of these as above up to 2026, and as `set_voltage`, `ramp_rate` since.
SNAKES = "2027"
PYTHON_WORDS = frozenset(
    {
        *(*CONFIG, *MECHANISM, *COMMANDS, *SIGNALS, *APPLIED_VOLTAGE, *APPLIED_DUTY, *BUS_VOLTAGE),
        *("getVoltage", "getDistance", "getRate", "getPosition", "getVelocity", "getChannel"),
        *("setInverted", "setDistancePerPulse", "setReverseDirection", "addFollower"),
        *("runOnce", "andThen", "withTimeout", "withName", "whileTrue", "onTrue", "isTest"),
        *("setDefaultCommand", "getName", "setName"),
    }
)


def find_season_of(name: str) -> str:
    """The season to which a RobotPy name belongs that was renamed: ``2027`` of ``set_voltage``.

    Args:
        name: a method, a keyword or a constant.

    Returns:
        ``2027``, ``2026`` for what was renamed then, or nothing for any other name.
    """
    if normalize_enum_constant(name) in DIRECTIONS and name not in DIRECTIONS:
        return SNAKES if name.isupper() else str(int(SNAKES) - 1)
    if spell_as_java(name) not in PYTHON_WORDS:
        return ""
    if "hrottle" in name or spell_as_java(name) != name:
        return SNAKES
    return str(int(SNAKES) - 1) if name.lower() != name else ""
