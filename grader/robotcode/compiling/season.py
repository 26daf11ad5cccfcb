"""Names of the season's libraries, by which a misspelled one is found.

No list is whole: a name that is not here is only called wrong where it is nearly one that is.
"""

import difflib
from collections.abc import Iterable, Iterator

from grader.robotcode.binding_facts import KINDS
from grader.robotcode.facts import ParseProblem
from grader.robotcode.ir import Import
from grader.robotcode.vocabulary import COMMANDS, PYTHON_WORDS, SIGNALS

# Java names that came with 2027, and what they were called until then. WPILib 2027 is not released:
# names as on allwpilib's development branch, whose early alphas still had test() and set().
PACKAGES_OF = {"edu.wpi.first.": 2026, "org.wpilib.": 2027}
MODES_OF_2027 = {"utility": "test", "isUtility": "isTest", "isUtilityEnabled": "isTestEnabled"}
MOTORS_OF_2027 = {"setThrottle": "set", "getThrottle": "get"}
# ... and of SysIdRoutine.Direction. Modes are left to exercise 5, which knows the early alphas.
DIRECTIONS_OF_2027 = {"FORWARD": "kForward", "REVERSE": "kReverse"}

NEARLY = 0.84  # how much of two names has to agree, from 0 to 1
SHORTEST = 4  # letters of a name that is compared

# Java: the package of each class that a lesson, an exercise or a hint names.
PACKAGES = {
    "edu.wpi.first.wpilibj2.command.sysid": "SysIdRoutine",
    "edu.wpi.first.wpilibj.sysid": "SysIdRoutineLog",
    "edu.wpi.first.wpilibj2.command": (
        "Command Commands CommandScheduler InstantCommand RunCommand SubsystemBase Subsystem "
        "SequentialCommandGroup ParallelCommandGroup WaitCommand PIDSubsystem FunctionalCommand "
        "ConditionalCommand ProfiledPIDSubsystem StartEndCommand"
    ),
    "edu.wpi.first.wpilibj2.command.button": (
        "CommandXboxController CommandPS4Controller CommandPS5Controller CommandJoystick "
        "CommandGenericHID Trigger RobotModeTriggers JoystickButton POVButton NetworkButton"
    ),
    "edu.wpi.first.units.measure": (
        "Voltage Distance LinearVelocity LinearAcceleration Angle AngularVelocity Current Time "
        "AngularAcceleration MutVoltage MutDistance MutLinearVelocity MutAngle MutAngularVelocity"
    ),
    "edu.wpi.first.wpilibj": (
        "DriverStation Encoder RobotController RobotBase TimedRobot XboxController Joystick "
        "DutyCycleEncoder DigitalInput Timer PS4Controller RobotState DataLogManager"
    ),
    "edu.wpi.first.wpilibj.motorcontrol": (
        "PWMSparkMax PWMTalonFX PWMVictorSPX PWMSparkFlex VictorSP Spark Talon MotorControllerGroup"
    ),
    "edu.wpi.first.math.controller": (
        "SimpleMotorFeedforward ElevatorFeedforward ArmFeedforward PIDController "
        "ProfiledPIDController BangBangController"
    ),
    "com.ctre.phoenix6.hardware": "TalonFX TalonFXS CANcoder Pigeon2",
    "com.ctre.phoenix6.controls": (
        "VoltageOut DutyCycleOut VelocityVoltage PositionVoltage MotionMagicVoltage Follower "
        "StrictFollower TorqueCurrentFOC NeutralOut VelocityTorqueCurrentFOC"
    ),
    "com.ctre.phoenix6.configs": (
        "TalonFXConfiguration FeedbackConfigs MotorOutputConfigs Slot0Configs CurrentLimitsConfigs"
    ),
    "com.ctre.phoenix6.signals": "GravityTypeValue StaticFeedforwardSignValue",
    "com.ctre.phoenix6": "SignalLogger StatusSignal BaseStatusSignal CANBus StatusCode",
    "com.revrobotics": "RelativeEncoder AbsoluteEncoder REVLibError",
    "com.revrobotics.spark": (
        "SparkMax SparkFlex SparkBase SparkLowLevel SparkClosedLoopController SparkRelativeEncoder"
    ),
    "com.revrobotics.spark.config": (
        "SparkMaxConfig SparkFlexConfig SparkBaseConfig EncoderConfig FeedForwardConfig"
    ),
    "java.util.function": "DoubleSupplier BooleanSupplier Supplier Consumer DoubleConsumer",
}
PWM_MOTORS = frozenset(  # WPILib's own motor controllers, whose methods WPILib alone names
    f"MotorController {PACKAGES['edu.wpi.first.wpilibj.motorcontrol']}".split()
)
CAN_DEVICES = frozenset(PACKAGES["com.ctre.phoenix6.hardware"].split())
HOME = {name: package for package, names in PACKAGES.items() for name in names.split()}
SEASON = ("edu.wpi.", "com.ctre.", "com.revrobotics", "java.util.function")
MODULES = {  # RobotPy: the modules each name may be imported from
    "commands2.sysid": "SysIdRoutine",
    "wpilib.sysid": "SysIdRoutineLog",
    "commands2": (
        "Command Subsystem SubsystemBase CommandScheduler InstantCommand RunCommand WaitCommand "
        "SequentialCommandGroup ParallelCommandGroup TimedCommandRobot cmd PIDSubsystem"
    ),
    "commands2.button": (
        "CommandXboxController CommandPS4Controller CommandPS5Controller CommandJoystick "
        "CommandGenericHID Trigger JoystickButton POVButton NetworkButton"
    ),
    "wpilib": (
        "Encoder PWMSparkMax PWMTalonFX PWMVictorSPX PWMSparkFlex VictorSP Spark DriverStation "
        "RobotController XboxController Joystick TimedRobot DutyCycleEncoder DigitalInput Timer "
        "DataLogManager SmartDashboard"
    ),
    "wpimath.controller": (
        "SimpleMotorFeedforwardMeters SimpleMotorFeedforwardRadians ElevatorFeedforward "
        "ArmFeedforward PIDController ProfiledPIDController"
    ),
}
MODULE_OF = {name: module for module, names in MODULES.items() for name in names.split()}
ROBOTPY = ("wpilib", "commands2", "wpimath", "phoenix6", "rev", "ntcore", "hal")
CLASSES = frozenset(HOME) | frozenset(MODULE_OF)

METHODS = frozenset(
    {
        *(*COMMANDS, *SIGNALS, *PYTHON_WORDS, "motor", "setControl", "getValueAsDouble"),
        *("withStaticFeedforwardSign", "withGravityType"),
        *("getMotorVoltage", "getSupplyVoltage", "getDutyCycle", "getStatorCurrent", "getValue"),
        *("getAppliedOutput", "getBusVoltage", "getEncoder", "configure", "getConfigurator"),
        *("quasistatic", "dynamic", "onFalse", "whileFalse", "toggleOnTrue", "negate"),
        *("getLeftY", "getRightY", "getLeftX", "getRightX", "leftBumper", "rightBumper"),
        *("calculate", "stopMotor", "runEnd", "startEnd", "getBatteryVoltage", "getHID"),
        *("setPosition", "getRaw", "positionConversionFactor", "velocityConversionFactor"),
        *("named", "withAutomaticName", "withPriority", "whenCanceled", "whenExited", "until"),
        *("executing", "requiring", "noRequirements", "park", "waitUntil", "fork", "await"),
    }
)
INHERITED = frozenset(  # what a subsystem, a command or a robot brings along
    {
        *("run", "runOnce", "runEnd", "startEnd", "startRun", "defer", "idle", "register"),
        *("setName", "getName", "setSubsystem", "getSubsystem", "addChild", "initSendable"),
        *("setDefaultCommand", "getDefaultCommand", "removeDefaultCommand", "getCurrentCommand"),
        *("periodic", "simulationPeriodic", "addPeriodic", "getPeriod", "toString", "hashCode"),
        *("equals", "getClass", "addRequirements", "isReal", "isSimulation", "super"),
        *("runRepeatedly", "idleFor", "idleUntil", "getRunningCommands"),  # of Commands v3
    }
)
PLAIN = frozenset(  # classes from which no field of interest is inherited
    {
        "Subsystem",
        "SubsystemBase",
        "Mechanism",
        "TimedRobot",
        "Object",
        "object",
        "Sendable",
        "TimedCommandRobot",
    }
)


def find_season(imports: Iterable[Import]) -> int:
    """The season that a Java file is written for, by the packages it imports; 0 if none tells."""
    for one in imports:
        for package, season in PACKAGES_OF.items():
            if one.path.startswith(package):
                return season
    return 0


def make_spelling_problem(kind: str, name: str, *, meant: str, line: int) -> ParseProblem:
    """The problem with a misspelled name.

    Args:
        kind: what it names: ``method``, ``class``, ``unit``.
        name: as the learner wrote it.
        meant: the name that was most likely meant.
        line: line in the source, from 1.
    """
    return ParseProblem(f"unknown {kind} {name}. Did you mean {meant}?", line, meant)


def find_call_on_class(method: str, owner: str, *, held: str, line: int) -> Iterator[ParseProblem]:
    """Report a test command that is called on the class SysIdRoutine instead of a routine.

    The Python example in WPILib's documentation does so (frc-docs, commit d57699a).

    Args:
        method: what is called.
        owner: the last name of what it is called on.
        held: how a routine in a field is written in this language.
        line: line in the source, from 1.
    """
    if owner == "SysIdRoutine" and method in KINDS:
        said = f"SysIdRoutine is the class, and it has no motors: write {held}.{method}(...)"
        yield ParseProblem(said, line)


def suggest_name(name: str, known: frozenset[str] | dict[str, str]) -> str:
    """The known name that another is a misspelling of; empty if it is none, or known itself."""
    if name in known or len(name) < SHORTEST:
        return ""
    folded = {one.lower(): one for one in known}
    if name.lower() in folded:
        return folded[name.lower()]
    close = difflib.get_close_matches(name, known, n=1, cutoff=NEARLY)
    return close[0] if close and abs(len(close[0]) - len(name)) < SHORTEST - 1 else ""
