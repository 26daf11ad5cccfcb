"""The words of the season for buttons, triggers and commands; spelled as in ``vocabulary``."""

import re

from grader.robotcode.binding_facts import Hold

# Methods of a trigger that bind a command, as `plain` gives them; the older names did the same.
HOLDS = {
    "whileTrue": Hold.WHILE,
    "whileHeld": Hold.WHILE,
    "whenHeld": Hold.WHILE,
    "whileActiveOnce": Hold.WHILE,
    "whileActiveContinuous": Hold.WHILE,
    "onTrue": Hold.PRESS,
    "whenPressed": Hold.PRESS,
    "whenActive": Hold.PRESS,
    "onChange": Hold.PRESS,
    "toggleOnTrue": Hold.TOGGLE,
    "toggleOnFalse": Hold.TOGGLE,
    "toggleWhenPressed": Hold.TOGGLE,
    "toggleWhenActive": Hold.TOGGLE,
    "whileFalse": Hold.RELEASED,
    "onFalse": Hold.RELEASED,
    "whenReleased": Hold.RELEASED,
    "whenInactive": Hold.RELEASED,
}

# A command's decorators with a condition: how many commands stand before it.
CONDITIONED = {
    "onlyIf": 0,
    "unless": 0,
    "onlyWhile": 0,
    "until": 0,
    "either": 2,
    "ConditionalCommand": 2,
}
DISCARDS = frozenset(  # what runs a function each time, and makes nothing of what it returns
    {"runOnce", "run", "runEnd", "startEnd", "startRun", "InstantCommand", "RunCommand",
     "StartEndCommand", "FunctionalCommand"}
)  # fmt: skip
BEFORE = frozenset({"sequence", "andThen", "beforeStarting", "SequentialCommandGroup"})
RACES = frozenset({"race", "raceWith", "ParallelRaceGroup", "withDeadline"})
DEADLINES = frozenset({"deadline", "deadlineWith", "deadlineFor", "ParallelDeadlineGroup"})
CHAINED = frozenset({"raceWith", "withDeadline", "deadlineWith", "deadlineFor"})  # of a command
HARMLESS = frozenset(  # what leaves when a command starts and ends as it is
    {"withName", "finallyDo", "handleInterrupt", "withInterruptBehavior", "ignoringDisable",
     "addRequirements", "setName", "alongWith", "parallel", "ParallelCommandGroup", "repeatedly",
     "RepeatCommand", "repeatingSequence", "asProxy", "proxy", "deferredProxy", "ProxyCommand",
     "defer", "DeferredCommand", "select", "SelectCommand", "WrapperCommand", "schedule",
     "ScheduleCommand", "get", "requireNonNull", "of", "entry", "ofEntries", "asList", "list",
     "tuple", "dict", "set", "Set"}
)  # fmt: skip
INSTANT = frozenset({"none", "print", "runOnce", "InstantCommand", "PrintCommand"})
ENDLESS = frozenset({"idle", "run", "runEnd", "startEnd", "startRun", "RunCommand",
                     "StartEndCommand"})  # fmt: skip
WAITING = frozenset({"waitSeconds", "waitTime", "WaitCommand"})
WAITING_UNTIL = frozenset({"waitUntil", "WaitUntilCommand"})
LOOPS = frozenset({"getDefaultButtonLoop", "getActiveButtonLoop"})  # they hold all bindings
SCHEDULER = frozenset({"getInstance"})  # of the CommandScheduler
SWITCHES = frozenset({"disable", "enable"})  # ... which turn it off and on
ENDED = frozenset({"until", "onlyWhile"})  # ... that end it, too
EXCEPT = frozenset({"unless", "until"})  # ... and let it run while the condition is false
CHOOSERS = frozenset({"addOption", "setDefaultOption", "addDefaultOption", "addCmd", "schedule"})

CONTROLLER = re.compile(
    r"(Command|NiDs)*(Xbox|PS[45]|Stadia|Gamepad|Joystick|GenericHID|Generic|HID)"
    r"(Controller|HID|Joystick)?"
)
WRAPPERS = frozenset({"Trigger", "Button", "NetworkButton", "InternalButton"})
BUTTONS = frozenset({"JoystickButton", "POVButton"})  # made of a controller and a number
BOTH = frozenset({"and", "and_", "whenBoth"})
EITHER = frozenset({"or", "or_"})
UNCHANGED = frozenset({"debounce", "rising", "falling", "castTo", "getAsBoolean", "get"})
NOT = frozenset({"negate", "not_", "not"})

# Ways to ask for test mode; WPILib 2027 calls it utility mode.
TEST_MODE = re.compile(r"(is)?(test|utility)(mode)?(enabled)?", re.IGNORECASE)
OTHER_MODE = re.compile(
    r"(is)?(teleop|autonomous|disabled|enabled|dsattached|fmsattached)(enabled)?", re.IGNORECASE
)
MODES_OF = frozenset({"RobotModeTriggers", "DriverStation", "RobotState", "RobotBase", "Robot"})

# An Xbox controller's buttons by their number.
NUMBERED = (
    "",
    "a",
    "b",
    "x",
    "y",
    "leftbumper",
    "rightbumper",
    "back",
    "start",
    "leftstick",
    "rightstick",
)


def find_button_name(method: str) -> str:
    """The name of a button, whichever method reads it: ``getAButton`` or ``a``."""
    bare = re.sub(r"^(get|k)(?=[A-Z])", "", method)
    bare = re.sub(r"(Button|Axis)?(Pressed|Released)?$", "", bare) or method
    return bare.replace("_", "").lower()
