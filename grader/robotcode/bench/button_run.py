"""Presses buttons as a driver would, in and out of each match mode, and lists the tests that ran.

A test of SysId that a program makes is known from its SysIdRoutine. Each input is pressed alone,
then with a second one held, then with a switch on the dashboard turned; what starts a test is held
to the test's end, and let go.
"""

import itertools
import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

from grader.robotcode.bench.facts import TESTS, ProgramFacts
from grader.robotcode.bench.routine_run import (
    Bench,
    is_subsystem,
)
from grader.robotcode.bench.simulation import Simulation, walk_fields
from grader.robotcode.library.base import Unknown
from grader.robotcode.library.commands import CommandScheduler
from grader.robotcode.library.world import PERIOD, WORLD, Joystick

Input = tuple[int, str, int]  # port, ``button`` or ``axis`` or ``pov``, number
SHORTEST, LONGEST = 32, 84  # loops that an input is held: all, and where a command waits
AFTER = 4  # loops that are watched after it
HELD = 640  # loops that a test is held to see its end, and what comes then
ALONE = 1550  # loops of a match in which nobody presses anything: 31 s
MATCH = ("teleop", "autonomous")
STATES = (  # what else a match can bring: alliance, every sensor, battery [V]
    ("Blue", False, 12.5),
    ("Red", True, 10.5),
)
HATS = (0, 90, 180, 270)  # [deg]
EVERY = [("button", number) for number in range(1, 11)] + [("pov", angle) for angle in HATS]
MOVING = 0.05  # [V] that a motor gets if it is driven


@dataclass(frozen=True)
class Factory:
    """A method that makes commands of tests.

    Args:
        owner, method: where it is.
        public: whether other classes may call it.
        line: of its declaration.
        tests: what it made.
    """

    owner: str
    method: str
    public: bool
    line: int
    tests: tuple[str, ...] = ()


@dataclass(frozen=True)
class Press:
    """A driver's action that runs a test, and its result.

    Args:
        test: by its name.
        inputs: what is held, in words.
        ports: of the controllers.
        switch: what has to be turned on a dashboard first; empty if nothing.
        mode: in which it was found.
        line: of the binding; 0 if no trigger started it.
        how: the method that bound it.
        text, comments: of that line, and the comments where the command of the test is made.
        delay: [s] until the test began.
        lasted: [s] until it ended by itself; infinite if it was still running.
        restarted: whether it began again while the input was held.
        stayed: whether it went on when the input was let go.
        stopped: whether a second press ended it, if it went on.
        moves: whether a motor is driven after the test, with nobody touching anything.
        together: what else of the tests ran.
        opened: the modes of a match in which the same input started it: with what else is so then.
        apart: whether its controller serves nothing but tests, beside another one.
    """

    test: str
    inputs: tuple[str, ...]
    ports: tuple[int, ...]
    switch: str
    mode: str
    line: int = 0
    how: str = ""
    text: str = ""
    comments: tuple[str, ...] = ()
    delay: float = 0.0
    lasted: float = math.inf
    restarted: bool = False
    stayed: bool = False
    stopped: bool = False
    moves: bool = False
    together: tuple[str, ...] = ()
    opened: tuple[str, ...] = ()
    apart: bool = False


@dataclass(frozen=True)
class ButtonFacts(ProgramFacts):
    """Facts about the buttons of a program.

    Args:
        routines: how many SysIdRoutines there are.
        factories: methods that make tests.
        made: every test that was made, and the line where the container asked for it.
        presses: for each test, what runs it.
        bindings: lines where a trigger got a command, with their method.
        released: tests that start when an input is let go, and the line of the binding.
        alone: mode -> tests that run although nobody presses anything.
        elsewhere: tests that a dashboard or autonomous starts, and where.
        uncalled: methods with bindings that nothing calls.
        shared: ports on which two controllers are made, and the line of the second.
        asked_once: the line that asks for test mode only while the program starts; 0 if none does.
    """

    routines: int = 0
    factories: tuple[Factory, ...] = ()
    made: tuple[tuple[str, int], ...] = ()
    presses: tuple[Press, ...] = ()
    bindings: tuple[tuple[int, str], ...] = ()
    released: tuple[tuple[str, int], ...] = ()
    alone: dict[str, tuple[str, ...]] = field(default_factory=dict)
    elsewhere: tuple[tuple[str, int], ...] = ()
    uncalled: tuple[tuple[str, int], ...] = ()
    shared: tuple[tuple[int, int], ...] = ()
    asked_once: int = 0


class ButtonBench(Bench):
    """A program whose buttons are pressed."""

    kind = ButtonFacts

    def __init__(self, *args: Any) -> None:
        super().__init__(*args)
        self.held: set[Input] = set()
        self.switch: tuple[str, Any] | None = None
        self.released: dict[str, int] = {}

    def look(self, facts: dict[str, Any]) -> None:
        """Record the bindings, what runs with no button pressed, and the effect of each press."""
        self.simulation = Simulation({}, {}, self.subject.refill)
        self.simulation.jammed = True  # so that no end of travel ends a test
        self.scheduler = CommandScheduler()
        facts |= self._describe_program()
        facts["alone"] = {mode: self._watch_alone(mode) for mode in ("test", *MATCH)}
        facts["presses"] = tuple(self._find_presses())

    # -- what there is ----------------------------------------------------------------------

    def _describe_program(self) -> dict[str, Any]:
        made = list(WORLD.tests)
        factories = self.guard(self.subject.list_factories)
        ports: dict[Any, int] = {}  # a number may be unknown
        shared = []
        for one in WORLD.controllers:
            if one._port in ports and isinstance(one._port, int):
                shared.append((one._port, int(one._line)))
            ports.setdefault(one._port, int(one._line))
        WORLD.joysticks = {port: Joystick() for port in ports if isinstance(port, int)}
        return {
            "factories": tuple(factories),
            "made": tuple((test, self._find_requested_line(lines)) for test, _, lines in made),
            "elsewhere": tuple(self._find_elsewhere()),
            "shared": tuple(shared),
        }

    def record_final_state(self, facts: dict[str, Any]) -> None:
        """Record bindings, releases and uncalled methods once the program has ended."""
        facts |= {
            "routines": len(WORLD.routines),
            "released": tuple(self.released.items()),
            "bindings": tuple((int(b.line), b.how) for b in WORLD.bindings),
            "uncalled": tuple(self.subject.find_uncalled()),
            "asked_once": next((int(at) for at, last in WORLD.asked.items() if last == 0), 0),
        }

    def _find_requested_line(self, lines: list[int]) -> int:
        """The line of the container that asked for a test: the first out of the routine's class."""
        if not lines:
            return 0
        owner = self.subject.owner_at(lines[0])
        others = [line for line in lines if self.subject.owner_at(line) != owner]
        return int([*others, *lines[1:2], lines[0]][0])

    def _find_elsewhere(self) -> Iterator[tuple[str, int]]:
        """Tests that a click on a dashboard, or autonomous, starts."""
        places = [
            *(("a dashboard starts {}", one, _get_line(one)) for one in WORLD.sendables.values()),
            *(("a chooser offers {}", one._options, _get_line(one)) for one in WORLD.choosers),
            *(
                ("the program starts {} by itself", one, int(line))
                for kind, one, _, line in self.scheduler._events if kind == "ask"
            ),
        ]  # fmt: skip
        command = self.guard(self.subject.autonomous)
        places.append(("autonomous runs {}", command, _get_line(command)))
        for said, thing, line in places:
            for test in find_tests(thing):
                yield said.format(test.replace("-", " ")), line

    # -- pressing ---------------------------------------------------------------------------

    def _set_mode(self, mode: str, state: tuple[str, bool, float] = STATES[0]) -> None:
        self.guard(self.scheduler.cancelAll)
        WORLD.running = {}
        WORLD.mode, WORLD.fms = mode, mode in MATCH
        WORLD.alliance, sensors, WORLD.battery = state
        devices: list[Any] = list(WORLD.devices)
        for one in devices:
            if hasattr(one, "_value") and isinstance(one._value, bool):
                one._value = sensors
        self._turn_switch(None)
        self._run_loops(2)

    def _turn_switch(self, switch: tuple[str, Any] | None) -> None:
        """Turn a switch on the dashboard; the one before goes back."""
        if self.switch is not None:
            path, before = self.switch
            if before is None:
                WORLD.network.pop(path, None)
            else:
                WORLD.network[path] = before
        self.switch = None
        if switch is not None:
            self.switch = (switch[0], WORLD.network.get(switch[0]))
            WORLD.network[switch[0]] = switch[1]

    def _set_inputs(self, inputs: Iterable[Input], *, on: bool) -> None:
        for port, kind, number in inputs:
            stick = WORLD.joysticks.setdefault(port, Joystick())
            if kind == "button":
                (stick.buttons.add if on else stick.buttons.discard)(number)
            elif kind == "pov":
                stick.pov = number if on else -1
            else:
                stick.axes[number] = 1.0 if on else 0.0

    def _run_loop(self) -> frozenset[str]:
        """One loop; the tests that ran in it."""
        WORLD.running = {}
        self.where = "periodic"
        self.guard(lambda: self.simulation.run_loop(self.scheduler.run))
        states = WORLD.running.values()
        return frozenset(state for state in states if state != "none")

    def _run_loops(self, count: int) -> frozenset[str]:
        return frozenset().union(*(self._run_loop() for _ in range(count)))

    def _watch_alone(self, mode: str) -> tuple[str, ...]:
        """The tests that run in a mode without any button pressed."""
        self._set_mode(mode)
        if mode == "autonomous":
            command = self.guard(self.subject.autonomous)
            if command is not None and not isinstance(command, Unknown):
                self.guard(lambda: self.scheduler.schedule(command))
        count = ALONE if mode == "teleop" else ALONE // 3
        return tuple(sorted(self._run_loops(count)))

    def _press_briefly(self, inputs: tuple[Input, ...]) -> frozenset[str]:
        """Hold some inputs for a moment; the tests that ran meanwhile."""
        before = set(self._list_running_commands())
        seen = len(self.scheduler._events)
        for one in inputs:
            self._set_inputs([one], on=True)
            self._run_loops(1)
        found: frozenset[str] = frozenset()
        for count in range(LONGEST):
            found |= self._run_loop()
            waits = any(
                find_tests(one) for one in self._list_running_commands() if one not in before
            )
            if found or (count > SHORTEST and not waits):
                break
        events = self.scheduler._events[seen:]
        if found:
            self.guard(self.scheduler.cancelAll)
        started = {
            test for kind, one, *_ in events if kind == "schedule" for test in find_tests(one)
        }
        self._release_inputs(inputs)
        return found | started if len(started) > 1 else found

    def _release_inputs(self, inputs: tuple[Input, ...]) -> None:
        self._set_inputs(inputs, on=False)
        for test in self._run_loops(2) & self._run_loops(2):
            lines = (int(b.line) for b in WORLD.bindings if test in find_tests(b.command))
            self.released.setdefault(test, next(lines, 0))
        self.guard(self.scheduler.cancelAll)
        self._run_loops(1)

    def _list_running_commands(self) -> list[Any]:
        return list(getattr(self.scheduler, "_scheduled", ()))

    def _list_inputs(self) -> list[Input]:
        """The inputs that a program reads; if it reads none, those of every controller."""
        found = [
            (one._port, kind, number)
            for one in WORLD.controllers
            for kind, number in one._used
            if isinstance(one._port, int)
        ]
        hats = {port for port, kind, _ in found if kind == "pov"}
        found += [(port, "pov", angle) for port in hats for angle in HATS]
        every = [(port, *one) for port in WORLD.joysticks for one in EVERY]
        return list(dict.fromkeys(found)) or every

    def _list_switches(self) -> list[tuple[str, Any]]:
        """The dashboard entries that a person can turn on."""
        found: list[tuple[str, Any]] = []
        for path, one in WORLD.switches.items():
            now = WORLD.network.get(path, next(iter(one.defaults), False))
            if one.defaults:
                found.append((path, not now))
        for one in WORLD.choosers:
            if one._path:
                found += [(f"{one._path}/selected", option) for option in one._options]
        return found

    def _find_presses(self) -> Iterator[Press]:
        found: dict[str, tuple[tuple[Input, ...], tuple[str, Any] | None, str, frozenset[str]]] = {}
        for mode in ("test", "teleop"):
            self._search_buttons(mode, None, found)
            for switch in self._list_switches():  # those that were asked for meanwhile
                self._search_buttons(mode, switch, found)
        for test in TESTS:
            if test in found:
                yield self._measure_test(test, *found[test])

    def _search_buttons(
        self, mode: str, switch: tuple[str, Any] | None, found: dict[str, Any]
    ) -> None:
        """Look for what starts tests, in a mode and with a switch turned."""
        if not set(TESTS) - set(found):
            return
        self._set_mode(mode)
        self._turn_switch(switch)
        inputs = self._list_inputs()
        singles: list[Input] = []
        for count in (1, 2):
            for pressed in itertools.combinations(inputs, count):
                if set(pressed) & set(singles):
                    continue
                if count > 1 and len(set(TESTS) - set(found)) == 0:
                    return
                tests = self._press_briefly(pressed)
                if tests and count == 1:
                    singles.append(pressed[0])
                for test in tests:
                    found.setdefault(test, (pressed, switch, mode, tests))

    def _measure_test(
        self,
        test: str,
        inputs: tuple[Input, ...],
        switch: tuple[str, Any] | None,
        mode: str,
        tests: frozenset[str],
    ) -> Press:
        """Hold the button of a test to its end, release it halfway, and try it in a match."""
        self._set_mode(mode)
        self._turn_switch(switch)
        self._set_inputs(inputs, on=True)
        ran, driven = [], []
        for _ in range(HELD):
            ran.append(test in self._run_loop())
            driven.append(self._is_driven())
        line, how = self._find_binding(test)
        first = ran.index(True) if True in ran else HELD
        end = next((k for k in range(first, HELD) if not ran[k]), HELD)
        self._set_inputs(inputs, on=False)
        self._run_loops(AFTER)
        moves = self._is_driven() or (not any(ran[end:]) and any(driven[end + AFTER :]))
        self.guard(self.scheduler.cancelAll)
        self._run_loops(2)
        stayed, stopped, moved = self._try_release(inputs, test)
        opened = tuple(self._try_match(test, inputs))
        asked = next(
            (self._find_requested_line(lines) for t, _, lines in WORLD.tests if t == test), 0
        )
        return Press(
            test,
            tuple(map(_describe_input, inputs)),
            tuple(dict.fromkeys(port for port, _, _ in inputs)),
            switch[0] if switch else "",
            mode,
            line,
            how,
            self.subject.text_at(line),
            self._find_comments(line, asked),
            delay=first * PERIOD,
            lasted=(end - first) * PERIOD if end < HELD else math.inf,
            restarted=any(ran[end:]),
            stayed=stayed,
            stopped=stopped,
            moves=moves or moved,
            together=tuple(sorted(tests - {test})),
            opened=opened,
            apart=self._is_apart(inputs),
        )

    def _try_release(self, inputs: tuple[Input, ...], test: str) -> tuple[bool, bool, bool]:
        """Whether a test goes on when its input is let go, ends by a second press, moves motors."""
        self._set_inputs(inputs, on=True)
        self._run_loops(SHORTEST if test in self._run_loops(SHORTEST) else LONGEST)
        self._set_inputs(inputs, on=False)
        self._run_loops(2)
        stayed = test in self._run_loops(AFTER)
        moves = not stayed and self._is_driven()
        stopped = False
        if stayed:
            self._set_inputs(inputs, on=True)
            self._run_loops(AFTER)
            self._set_inputs(inputs, on=False)
            stopped = test not in self._run_loops(AFTER)
        self.guard(self.scheduler.cancelAll)
        return stayed, stopped, moves

    def _is_driven(self) -> bool:
        """Whether a motor gets a voltage."""
        got = [one._applied for one in self.simulation.motors]
        return any(abs(one) > MOVING for one in got if not isinstance(one, Unknown))

    def _try_match(self, test: str, inputs: tuple[Input, ...]) -> Iterator[str]:
        """The states of a match in which the same inputs, or one of them, start a test."""
        for mode in MATCH:
            for state in STATES:
                self._set_mode(mode, state)
                if test in self._press_briefly(inputs):
                    yield mode
                    break

    def _find_binding(self, test: str) -> tuple[int, str]:
        """The line and the method that bound a test to the pressed button."""
        running = [one for one in self._list_running_commands() if test in find_tests(one)]
        line = int(running[0]._scheduled_line) if running else 0
        if not line:  # a command scheduled the test: the binding of that one
            bound = {int(b.line) for b in WORLD.bindings}
            events = ((kind, int(at)) for kind, *_, at in reversed(self.scheduler._events))
            line = next((at for kind, at in events if kind == "schedule" and at in bound), 0)
        exact = [b for b in WORLD.bindings if test in find_tests(b.command)]
        same = [b for b in exact or WORLD.bindings if int(b.line) == line]
        near = next(iter(same or exact), None)
        return (int(near.line), near.how) if near else (line, "")

    def _find_comments(self, *lines: int) -> tuple[str, ...]:
        found = (str(self.subject.comment_at(line)) for line in lines)
        return tuple(dict.fromkeys(filter(None, found)))

    def _is_apart(self, inputs: tuple[Input, ...]) -> bool:
        """Whether the controller of some inputs serves nothing else, and is not the only one."""
        ports = {port for port, _, _ in inputs}
        others = [one for one in WORLD.controllers if one._port not in ports]
        own = {one for one in WORLD.controllers if one._port in ports}
        used = {(one._port, *key) for one in own for key in one._used}
        return (bool(others) or bool(ports - {0})) and used <= self.test_inputs()

    def test_inputs(self) -> set[Input]:
        """The inputs whose triggers belong to bindings of tests."""
        lines = {int(b.line) for b in WORLD.bindings if find_tests(b.command)}
        return {
            (one._port, *key)
            for one in WORLD.controllers
            for key, line in one._used.items()
            if int(line) in lines or not lines
        }


def find_tests(command: Any) -> list[str]:
    """The tests of SysId that a command runs, itself or in its parts."""
    made = {id(one): test for test, one, _ in WORLD.tests}
    if id(command) in made:
        return [made[id(command)]]
    parts = walk_fields(command, leave=is_subsystem)
    return [made[id(one)] for _, _, one in parts if id(one) in made]


def _describe_input(one: Input) -> str:
    """An input as robot code names it: ``Y button (y()) of the controller at port 0``."""
    port, kind, number = one
    users = (hid for hid in WORLD.controllers if hid._port == port)
    said = next((hid._describe(kind, number) for hid in users), f"{kind} {number}")
    return f"{said} of the controller at port {port}"


def _get_line(thing: Any) -> int:
    line = getattr(thing, "_line", 0)
    return int(line) if isinstance(line, int) else 0
