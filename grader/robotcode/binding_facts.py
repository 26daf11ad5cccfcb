"""What a robot program says about the buttons that start its SysId tests; Java and RobotPy alike.

As in ``facts``: what cannot be decided by reading is empty or in ``unread``, and never guessed.
"""

from dataclasses import dataclass
from enum import Enum

from grader.robotcode.facts import ParseProblem

KINDS = ("quasistatic", "dynamic")
DIRECTIONS = ("forward", "reverse")


class Hold(Enum):
    """How long a binding lets its command run."""

    WHILE = "while"  # whileTrue: until the button is let go
    PRESS = "press"  # onTrue: until the command ends by itself, whatever the button does
    TOGGLE = "toggle"  # toggleOnTrue: until the button is pressed once more
    RELEASED = "released"  # whileFalse, onFalse: while nobody presses it
    UNKNOWN = "unknown"


class Guard(Enum):
    """What else has to be true before a binding starts its command."""

    TEST_MODE = "test mode"
    CHORD = "chord"  # a second button has to be held
    TOGGLE = "toggle"  # a switch, a dashboard entry, a constant
    ASKED_ONCE = "asked once"  # test mode, asked while the bindings are made: never true
    OTHER_MODE = "other mode"  # teleop, say, or every mode but test mode: guards nothing


class HindranceKind(Enum):
    """Why a test that is bound may not start, or may end early."""

    NEVER = "never"  # a condition that never holds, or a wait before it
    CLOSED = "closed"  # the trigger never becomes true
    CUT = "cut"  # it is ended long before its own timeout
    DELAYED = "delayed"  # the trigger answers late, or how late cannot be told
    CLEARED = "cleared"  # the bindings are removed again
    DISABLED = "disabled"  # the command scheduler is turned off
    EMPTIED = "emptied"  # the routine's field is set to null
    UNREAD = "unread"  # a decorator that is not known, or a time that cannot be told


@dataclass(frozen=True)
class Hindrance:
    """What keeps a bound test from starting, or ends it early.

    Args:
        kind: why.
        text: the source text that does it.
    """

    kind: HindranceKind
    text: str


@dataclass(frozen=True)
class SysIdTest:
    """One of the four tests.

    Args:
        kind: ``quasistatic`` or ``dynamic``.
        direction: ``forward`` or ``reverse``; ``any`` where a parameter decides; empty if it
            cannot be told.
        read: whether the call of the routine was seen, and not only the name of a method.
    """

    kind: str
    direction: str
    read: bool = True


@dataclass(frozen=True)
class Binding:
    """A trigger bound to a command that runs a test.

    Args:
        tests: the tests the command runs; more than one if it runs several.
        hold: how long it lets them run.
        trigger: the same text for the same trigger; empty if unknown.
        controllers: the controllers whose buttons are in the trigger.
        guards: what else has to be true.
        scheduled: whether the command only hands the test to the scheduler, and ends at once.
        stopped: whether the command has a condition of its own that ends it.
        comment: the comments beside it and directly above it.
        text: its source text.
        line: its line, from 1.
        hindrances: what keeps the tests from starting, or ends them early.
    """

    tests: tuple[SysIdTest, ...]
    hold: Hold
    trigger: str
    controllers: tuple[str, ...]
    guards: tuple[Guard, ...]
    scheduled: bool
    stopped: bool
    comment: str
    text: str
    line: int
    hindrances: tuple[Hindrance, ...] = ()


@dataclass(frozen=True)
class Controller:
    """A controller in a person's hands.

    Args:
        name: its variable.
        port: its number at the driver station; None if unknown.
        uses: where it does something else than start a test: text and line.
    """

    name: str
    port: int | None
    uses: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True)
class Factory:
    """A method that makes the command of a test.

    Args:
        test: which; ``any`` direction where its parameter decides.
        method: its name.
        public: whether other classes may call it.
        line: its line; 0 if it stands in another file.
    """

    test: SysIdTest
    method: str
    public: bool
    line: int


@dataclass(frozen=True)
class BindingFacts:
    """All that the text of a robot program says about starting SysId's tests.

    Args:
        language: ``java`` or ``python``.
        factories: the methods that make the tests' commands, in these files.
        bindings: the triggers that start tests.
        controllers: the controllers it makes.
        elsewhere: where a test is started without a trigger, in a chooser, say: text and line.
        uncalled: private methods with bindings that nothing calls: name and line.
        unread: bindings whose command cannot be told by reading.
        problems: syntax errors; when there are any, the rest is empty.
        compile_errors: what keeps the file from being compiled, as far as text can tell.
        season: the season that its imports tell, in Java; 0 if they tell none.
    """

    language: str
    factories: tuple[Factory, ...] = ()
    bindings: tuple[Binding, ...] = ()
    controllers: tuple[Controller, ...] = ()
    elsewhere: tuple[tuple[str, int], ...] = ()
    uncalled: tuple[tuple[str, int], ...] = ()
    unread: tuple[ParseProblem, ...] = ()
    problems: tuple[ParseProblem, ...] = ()
    compile_errors: tuple[ParseProblem, ...] = ()
    season: int = 0
