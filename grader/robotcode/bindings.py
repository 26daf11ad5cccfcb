"""From a file to the facts about the buttons that start its SysId tests.

Every method is gone through once from where it is called, with what it is given; a loop over a list
that is written out, once for each element.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from grader.robotcode.binding_facts import (
    Binding,
    BindingFacts,
    Guard,
    Hindrance,
    HindranceKind,
    Hold,
)
from grader.robotcode.button_vocabulary import CHOOSERS, HOLDS, LOOPS, SCHEDULER, SWITCHES
from grader.robotcode.closure import (
    BoundNode,
    enter_call,
    list_called_functions,
    resolve_bound,
    resolve_call,
)
from grader.robotcode.commands import CommandReader, TestsRun
from grader.robotcode.comments import find_comments_near, list_comments
from grader.robotcode.compiling import find_compile_errors
from grader.robotcode.compiling.season import find_season
from grader.robotcode.constant_folding import ConstantFolder
from grader.robotcode.constant_truth import TruthFolder
from grader.robotcode.controllers import find_controllers
from grader.robotcode.factories import find_factories, is_private
from grader.robotcode.facts import ParseProblem
from grader.robotcode.files import Files
from grader.robotcode.ir import Branch, Call, Class, Function, Items, Loop, Node, SourceSpan
from grader.robotcode.name_resolution import Method, get_last_name, get_method_name
from grader.robotcode.scope import Scope, walk_with_scopes
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.triggers import TriggerKind, TriggerPart, Triggers

DEEPEST = 120  # pieces of code one inside the other
LEAVES = re.compile(r"if\s*\(?\s*true\s*\)?\s*[:{]?\s*return", re.IGNORECASE)
MOST_CALLS = 5  # methods followed, one inside the other
MOST_STEPS = 50_000  # pieces of code gone through; a robot's container has a thousandth
EVERY_LOOP = re.compile(r"periodic$", re.IGNORECASE)  # methods that WPILib calls every 20 ms
MODE = r"(test|utility) mode( of RobotModeTriggers)?"  # the key of a part that asks for it
ASKED = re.compile(MODE)
OPPOSED = re.compile(  # ... and of one that does not hold in test mode
    rf"not\({MODE}\)|(is)?(teleop|autonomous)(enabled)?", re.IGNORECASE
)
_GUARDS = {
    TriggerKind.TEST_MODE: Guard.TEST_MODE,
    TriggerKind.SWITCH: Guard.TOGGLE,
    TriggerKind.OTHER_MODE: Guard.OTHER_MODE,
    TriggerKind.ONCE: Guard.ASKED_ONCE,
}


@dataclass(frozen=True)
class _Way:
    """How a piece of code was come to.

    Args:
        conditions: what was asked on the way, while the program starts.
        places: the calls and the elements of lists on the way.
        functions: the functions on the way, so that none calls itself.
        depth: how many pieces of code are around it.
    """

    conditions: tuple[BoundNode, ...] = ()
    places: tuple[SourceSpan, ...] = ()
    functions: tuple[Function, ...] = ()
    depth: int = 0


def read_bindings(path: Path) -> BindingFacts:
    """Read which buttons of a robot program start its SysId tests, without running it.

    Args:
        path: a ``.java`` or ``.py`` file: the RobotContainer, say.

    Raises:
        UnreadableFile: it is missing, empty, too large, not text, or neither Java nor Python.
    """
    names = SymbolTable(Files(path))
    if names.main.problems:
        return BindingFacts(names.main.language, problems=names.main.problems)
    return _Reader(names).facts()


class _Reader:
    """Goes through one file."""

    def __init__(self, names: SymbolTable) -> None:
        measures = ConstantFolder(names)
        self._names = names
        self._commands = CommandReader(names, measures)
        self._triggers = Triggers(names, measures)
        self._truth = TruthFolder(names, measures)
        self._comments = list_comments(names.main)
        self._bindings: list[Binding] = []
        self._start = 0  # how many bindings there were before the method that is gone through
        self._disabled: Hindrance | None = None  # the call that turned the scheduler off
        self._interruptions: list[Hindrance] = []  # calls that end all commands in every loop
        self._elsewhere: dict[str, int] = {}
        self._unread: list[ParseProblem] = []
        self._steps = 0

    def facts(self) -> BindingFacts:
        """All facts of the file."""
        main = self._names.main
        every = list(walk_with_scopes(main.body, Scope(main)))
        called_ = {
            f for node, scope in every for f in list_called_functions(node, scope, self._names)
        }
        uncalled = []
        for node, scope in every:
            if isinstance(node, Class):
                fields = [one for one in node.body if not isinstance(one, Function | Class)]
                self._several(fields, BoundNode(node, scope.within(node)), _Way())
            elif isinstance(node, Function) and node.name and node not in called_:
                before = self._start = len(self._bindings)
                way = _Way(functions=(node,))
                self._several(node.body, BoundNode(node, scope.within(node)), way)
                if len(self._bindings) > before and is_private(node, main.language):
                    uncalled.append((node.name, node.place.line))
        top = [one for one in main.body if not isinstance(one, Function | Class)]
        self._several(top, BoundNode(top[0], Scope(main)) if top else None, _Way())
        off = [self._disabled] if self._disabled is not None else []
        self._start = 0
        for hindrance in (*off, *self._interruptions):
            self._hinder_all(hindrance)
        return BindingFacts(
            main.language,
            factories=tuple(find_factories(every, self._names, self._commands)),
            bindings=tuple(dict.fromkeys(self._bindings)),
            controllers=find_controllers(every, self._names, self._triggers),
            elsewhere=tuple(self._elsewhere.items()),
            uncalled=tuple(uncalled),
            unread=tuple(dict.fromkeys(self._unread)),
            compile_errors=find_compile_errors(self._names),
            season=find_season(main.imports),
        )

    def _several(
        self,
        nodes: Iterator[Node] | list[Node] | tuple[Node, ...],
        around: BoundNode | None,
        way: _Way,
    ) -> None:
        for node in nodes:
            if around is not None:
                self._through(around.with_node(node), way)
            if isinstance(node, Branch) and LEAVES.match(node.place.text):
                return

    def _through(self, seen: BoundNode, way: _Way) -> None:
        """Go through a piece of code, what is inside it first."""
        node = seen.node
        self._steps += 1
        if way.depth > DEEPEST or self._steps > MOST_STEPS or isinstance(node, Class):
            return
        if isinstance(node, Function):
            if not node.name:
                within = replace(seen, scope=seen.scope.within(node))
                self._several(node.body, within, replace(way, depth=way.depth + 1))
            return
        if isinstance(node, Loop):
            self._loop(seen, node, way)
            return
        inner = replace(way, depth=way.depth + 1)
        if isinstance(node, Branch) and node.inside and node.place.text.startswith(("if", "elif")):
            condition = seen.with_node(node.inside[0])
            if self._truth.fold(condition) is False:
                return
            inner = replace(inner, conditions=(*way.conditions, condition))
        self._several(node.parts, seen, inner)
        if isinstance(node, Call):
            self._call(seen, node, way)

    def _loop(self, seen: BoundNode, loop: Loop, way: _Way) -> None:
        """Go through a loop's body for each element, where they are written out."""
        several = resolve_bound(seen.with_node(loop.collection), self._names)
        items = self._items(several)
        inner = replace(way, depth=way.depth + 1)
        if not items:
            self._several(loop.body, seen, inner)
        for item in items:
            element = several.with_node(item)
            parts = item.items if isinstance(item, Items) else (item,)
            named = dict(zip(loop.variables, map(several.with_node, parts), strict=False))
            if len(loop.variables) == 1:
                named = {loop.variables[0]: element}
            given = {**seen.given, **named}
            there = replace(inner, places=(*inner.places, item.place))
            self._several(loop.body, replace(seen, given=given), there)

    def _items(self, several: BoundNode) -> tuple[Node, ...]:
        """The elements of a list that is written out, or of several side by side."""
        node = several.node
        if isinstance(node, Items):
            return node.items
        if not isinstance(node, Call):
            return ()
        if get_last_name(node.target) == "zip":
            columns = [
                self._items(resolve_bound(several.with_node(arg), self._names)) for arg in node.args
            ]
            return tuple(Items(row[0].place, row) for row in zip(*columns, strict=False))
        return node.args if get_last_name(node.target) in {"of", "asList"} else ()

    def _call(self, seen: BoundNode, call: Call, way: _Way) -> None:
        name = get_method_name(call)
        functions = resolve_call(seen, self._names)
        if not functions and name in CHOOSERS:
            self._chosen(seen, call)
        elif not functions and call.owner is not None:
            owner = call.owner
            if name == "clear" and self._call_at_start(seen, owner) in LOOPS:
                # all bindings made so far are lost where the loop that asks the buttons is cleared
                self._hinder_all(Hindrance(HindranceKind.CLEARED, call.place.text))
            elif name in SWITCHES and self._call_at_start(seen, owner) in SCHEDULER:
                off = Hindrance(HindranceKind.DISABLED, call.place.text)
                self._disabled = off if name == "disable" else None
            elif name == "cancelAll":
                self._cancelled(seen, call, owner, way)
            elif name in HOLDS and call.all_args:
                self._bound(seen, call, owner, way)
        elif len(functions) == 1 and functions[0][1].module is self._names.main:
            self._entered(seen, call, functions[0], way)

    def _entered(self, seen: BoundNode, call: Call, method: Method, way: _Way) -> None:
        """Go through a function of this file, with what it is called with."""
        function = method[0]
        if function in way.functions or len(way.functions) > MOST_CALLS:
            return
        into = replace(
            way,
            places=(*way.places, call.place) if call.all_args else way.places,
            functions=(*way.functions, function),
            depth=way.depth + 1,
        )
        self._several(function.body, enter_call(seen, method), into)

    def _cancelled(self, seen: BoundNode, call: Call, owner: Node, way: _Way) -> None:
        """A test ends at once where every loop of the robot cancels all commands."""
        every_loop = bool(way.functions) and EVERY_LOOP.search(way.functions[0].name)
        if every_loop and not way.conditions and self._call_at_start(seen, owner) in SCHEDULER:
            self._interruptions.append(Hindrance(HindranceKind.CUT, call.place.text))

    def _call_at_start(self, seen: BoundNode, owner: Node) -> str:
        """The method that a node calls while the program starts; empty in a lambda."""
        found = resolve_bound(seen.with_node(owner), self._names).node
        later = any(not one.name for one in seen.scope.functions)
        return get_method_name(found) if isinstance(found, Call) and not later else ""

    def _hinder_all(self, lost: Hindrance) -> None:
        """Every binding that the method which is gone through has made gets a hindrance."""
        self._bindings[self._start :] = [
            replace(one, hindrances=(*one.hindrances, lost))
            for one in self._bindings[self._start :]
        ]

    def _chosen(self, seen: BoundNode, call: Call) -> None:
        """A test that somebody chooses instead of holding a button."""
        owner = () if call.owner is None else (call.owner,)
        parts = (*call.all_args, *owner)
        if any(self._commands.find_tests(seen.with_node(node)).tests for node in parts):
            self._elsewhere.setdefault(call.place.text, call.target.place.line)

    def _bound(self, seen: BoundNode, call: Call, owner: Node, way: _Way) -> None:
        command = seen.with_node(call.all_args[-1])
        runs = self._commands.find_tests(command)
        line = call.target.place.line
        said = f"{get_last_name(call.target)}({command.node.place.text})"
        if runs.either or (runs.unclear is not None and not runs.tests):
            self._unread.append(ParseProblem(f"the grader cannot see which test {said} runs", line))
        if runs.either or not runs.tests:
            return
        trigger = seen.with_node(owner)
        parts = self._triggers.find_parts(trigger)
        kinds = {part.asks for part in parts}
        silent = {TriggerKind.NOTHING, TriggerKind.DELAYED}
        keys = sorted({part.key for part in parts if part.asks not in silent})
        released = TriggerKind.RELEASED in kinds and TriggerKind.BUTTON not in kinds
        controllers = (part.controller for part in parts if part.controller)
        self._bindings.append(
            Binding(
                runs.tests,
                Hold.RELEASED if released else HOLDS[get_method_name(call)],
                "" if TriggerKind.UNKNOWN in kinds else " + ".join(keys),
                tuple(dict.fromkeys(controllers)),
                self._guards(parts, runs, way),
                runs.scheduled,
                runs.stopped,
                self._said((*way.places, call.place)),
                said,
                way.places[-1].line if seen.given and way.places else line,
                (*runs.hindrances, *self._hindered(trigger, parts, runs)),
            )
        )

    def _hindered(
        self, trigger: BoundNode, parts: tuple[TriggerPart, ...], runs: TestsRun
    ) -> Iterator[Hindrance]:
        """Why a trigger never becomes true, alone or with its command's condition, or only late."""
        keys = [part.key for part in self._asked(parts, runs)]
        never = self._truth.fold(trigger) is False
        if never or (any(map(OPPOSED.fullmatch, keys)) and any(map(ASKED.fullmatch, keys))):
            yield Hindrance(HindranceKind.CLOSED, trigger.node.place.text)
        for part in parts:
            if part.asks is TriggerKind.DELAYED:
                yield Hindrance(HindranceKind.DELAYED, part.key)

    def _guards(
        self, parts: tuple[TriggerPart, ...], runs: TestsRun, way: _Way
    ) -> tuple[Guard, ...]:
        """What has to be true beside the button."""
        asked = self._asked(parts, runs)
        found = [_GUARDS[part.asks] for part in asked if part.asks in _GUARDS]
        buttons = {part.key for part in asked if part.asks is TriggerKind.BUTTON}
        if len(buttons) > 1:
            found.append(Guard.CHORD)
        for condition in way.conditions:
            for part in self._triggers.find_parts(condition):
                once = part.asks is TriggerKind.TEST_MODE
                if once or part.asks is TriggerKind.SWITCH:
                    found.append(Guard.ASKED_ONCE if once else Guard.TOGGLE)
        return tuple(dict.fromkeys(found))

    def _asked(self, parts: tuple[TriggerPart, ...], runs: TestsRun) -> list[TriggerPart]:
        """What the trigger and the command's own decorators ask; all of it has to hold."""
        asked = [*parts]
        for condition in runs.conditions:
            asked += self._triggers.find_parts(condition)
        for condition in runs.exceptions:
            asked += self._triggers.find_negated_parts(condition)
        return asked

    def _said(self, places: tuple[SourceSpan, ...]) -> str:
        """The comments beside the places that led to a binding."""
        found = dict.fromkeys(
            find_comments_near(self._comments, place.line, place.last_line)
            for place in places
            if place.source is self._names.main.source
        )
        return " ".join(filter(None, found))
