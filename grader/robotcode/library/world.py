"""The world that a program runs in: time, battery, driver station, and every device that it made.

The bench turns it, loop by loop; the fakes read it and write what a program did with them.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from grader.robotcode.library.devices import Device

PERIOD = 0.02  # [s] one loop of a robot program
BATTERY = 12.5  # [V] charged
GEARING = 100.0  # turns of a motor for one of the shaft that has an absolute sensor


@dataclass
class Joystick:
    """The state of a driver's controller: buttons from 1 on, axes from -1 to 1, a hat."""

    buttons: set[int] = field(default_factory=set)
    axes: dict[int, float] = field(default_factory=dict)
    pov: int = -1  # [deg] clockwise from up; -1 while nobody touches it


@dataclass
class World:
    """Everything around a program that is not the program.

    Args:
        language: of the program, ``java`` or ``python``.
        time: [s] since the program started.
        battery: [V] at the moment.
        mode: ``disabled``, ``teleop``, ``autonomous`` or ``test``.
        alliance: ``Red``, ``Blue`` or empty.
        fms: whether the field's system is attached, as in a match.
        joysticks: by port; a port that is not here has no controller plugged in.
        network: every value on the dashboards and in NetworkTables, by its whole path.
        devices: every motor and sensor, in the order in which they were made.
        each_loop: what runs by itself once a loop, as a Notifier does.
        blocked: [s] for which the program kept its own loop waiting.
        assume: what a condition is taken for that nobody can know.
        undecided: the conditions that were, and the line of each.
        where: the file's line that is being run.
        stack: the lines of the calls that led there, the innermost first; 0 for another file.
        logged: what the SysId log callback wrote since the bench last looked.
        scheduler: the one of all commands; None until it is asked for.
        routines: every SysIdRoutine.
        tests: every command of a test: its name, the command, the lines that asked for it.
        running: what state each log was last told.
        bindings: every command that a trigger starts.
        controllers: each with what the program reads of it.
        button_edges: what each button was when its edges were last asked for.
        asked: lines that ask for test mode, and when first.
        switches: every boolean of a dashboard, by its path.
        choosers: every list to choose from.
        sendables: what else is on a dashboard, as a command that a click starts.
        feedforwards, pids, configurations: every one of a library's that was made.
        unknown: parts of libraries that have no fake, and the line that uses them first.
        stored: settings that a device had before the program started, by its number.
    """

    language: str = "java"
    time: float = 0.0
    battery: float = BATTERY
    mode: str = "disabled"
    alliance: str = "Blue"
    fms: bool = False
    joysticks: dict[int, Joystick] = field(default_factory=dict)
    network: dict[str, Any] = field(default_factory=dict)
    devices: list["Device"] = field(default_factory=list)
    each_loop: list[Callable[[], Any]] = field(default_factory=list)
    blocked: float = 0.0
    assume: bool = False
    undecided: dict[str, int] = field(default_factory=dict)
    where: Callable[[], int] = field(default=lambda: 0)
    stack: Callable[[], list[int]] = field(default=list)
    logged: list[Any] = field(default_factory=list)
    scheduler: Any = None
    routines: list[Any] = field(default_factory=list)
    tests: list[Any] = field(default_factory=list)
    running: dict[Any, str] = field(default_factory=dict)
    bindings: list[Any] = field(default_factory=list)
    controllers: list[Any] = field(default_factory=list)
    button_edges: dict[Any, bool] = field(default_factory=dict)
    asked: dict[int, float] = field(default_factory=dict)
    switches: dict[str, Any] = field(default_factory=dict)
    choosers: list[Any] = field(default_factory=list)
    sendables: dict[str, Any] = field(default_factory=dict)
    feedforwards: list[Any] = field(default_factory=list)
    pids: list[Any] = field(default_factory=list)
    configurations: list[Any] = field(default_factory=list)
    unknown: dict[str, int] = field(default_factory=dict)
    stored: dict[Any, dict[str, Any]] = field(default_factory=dict)

    def reset(self, language: str, *, assume: bool = False) -> None:
        """Reset the state to that of a robot just switched on."""
        fresh = World(language=language, assume=assume)
        self.__dict__.update(fresh.__dict__)

    def decide(self, text: str) -> bool:
        """Decide an unknown condition as assumed, and record that it mattered."""
        self.undecided.setdefault(text, self.where())
        return self.assume

    @property
    def enabled(self) -> bool:
        """Whether motors may move."""
        return self.mode != "disabled"


WORLD = World()
