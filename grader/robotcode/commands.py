"""Which SysId tests a command runs, through factories, decorators and compositions."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from grader.robotcode.binding_facts import KINDS, Hindrance, HindranceKind, SysIdTest
from grader.robotcode.button_vocabulary import CONDITIONED, DISCARDS, ENDED, EXCEPT
from grader.robotcode.closure import (
    BoundNode,
    enter_call,
    find_definitions,
    infer_bound_class,
    is_open_parameter,
    resolve_bound,
    resolve_call,
)
from grader.robotcode.constant_folding import ConstantFolder
from grader.robotcode.decorators import Decorators, make_hindrance
from grader.robotcode.ir import (
    Call,
    Choice,
    Element,
    Function,
    FunctionParameter,
    Items,
    Member,
    Name,
    Node,
    Null,
    Opaque,
    Reference,
    Return,
)
from grader.robotcode.name_resolution import (
    find_called_functions,
    get_last_name,
    get_method_name,
    list_returned_nodes,
)
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import DIRECTIONS, normalize_enum_constant

DEEPEST = 12  # methods and compositions one inside the other
KIND = re.compile(r"(quasi)|(dynamic)", re.IGNORECASE)
WAY = re.compile(r"(forward|fwd)|(reverse|backward|rev(?![a-z])|bwd)", re.IGNORECASE)


@dataclass(frozen=True)
class TestsRun:
    """The SysId tests that a command runs.

    Args:
        tests: the tests.
        conditions: what its own decorators ask before it starts: they must hold.
        exceptions: what its own decorators ask before it starts: they must not hold.
        scheduled: whether a test is only handed to the scheduler.
        stopped: whether a decorator ends it early.
        unclear: what could not be told; None if nothing was left open.
        either: whether it is one of the tests, and which one cannot be told.
        hindrances: what keeps a test from starting, or ends it early.
    """

    tests: tuple[SysIdTest, ...] = ()
    conditions: tuple[BoundNode, ...] = ()
    exceptions: tuple[BoundNode, ...] = ()
    scheduled: bool = False
    stopped: bool = False
    unclear: Node | None = None
    either: bool = False
    hindrances: tuple[Hindrance, ...] = ()


class CommandReader:
    """Finds the SysId tests that a command runs.

    Args:
        names: the names of the program.
        measures: its constants.
    """

    def __init__(self, names: SymbolTable, measures: ConstantFolder) -> None:
        self._names = names
        self._decorators = Decorators(names, measures)

    def find_tests(self, seen: BoundNode, *, depth: int = 0) -> TestsRun:
        """The tests that a command, or a factory of one, runs."""
        if depth > DEEPEST:
            return TestsRun(unclear=seen.node)
        seen = resolve_bound(seen, self._names)
        node = seen.node
        if isinstance(node, Call):
            return self._call(seen, node, depth + 1)
        if isinstance(node, Reference | Member) and self._is_method(seen, node):
            call = Call(node.place, Member(node.place, node.owner, node.name), ())
            return self._call(seen.with_node(call), call, depth + 1)
        if isinstance(node, Name | Member | FunctionParameter | Element):
            return TestsRun(unclear=node)
        return self._parts(seen, node, depth + 1)

    def _parts(self, seen: BoundNode, node: Node, depth: int) -> TestsRun:
        """What a choice, a list or a lambda runs."""
        parts = node.parts
        if isinstance(node, Choice):
            return self._one_of(map(seen.with_node, self._chosen(seen, node)), depth)
        if isinstance(node, Function):
            seen, parts = replace(seen, scope=seen.scope.within(node)), node.body
        elif not isinstance(node, Items | Opaque | Return):
            parts = ()
        return join_tests_run(self.find_tests(seen.with_node(one), depth=depth) for one in parts)

    def _one_of(self, several: Iterable[BoundNode], depth: int) -> TestsRun:
        """One of several commands; which one, only the running program knows."""
        found = join_tests_run(self.find_tests(one, depth=depth) for one in several)
        return replace(found, either=True) if len(found.tests) > 1 else found

    def _chosen(self, seen: BoundNode, choice: Choice) -> tuple[Node, ...]:
        """The part of a choice that holds, or both."""
        said = resolve_bound(seen.with_node(choice.condition), self._names).node.place.text.lower()
        both = (choice.one, choice.other)
        return {"true": both[:1], "false": both[1:]}.get(said, both)

    def _is_method(self, seen: BoundNode, node: Member) -> bool:
        """Whether a member is a method that is named, not called."""
        if isinstance(node, Reference):
            return True
        call = Call(node.place, node, ())
        return bool(find_called_functions(call, seen.scope, self._names))

    def _call(self, seen: BoundNode, call: Call, depth: int) -> TestsRun:
        name = get_method_name(call)
        functions = resolve_call(seen, self._names)
        if len(functions) == 1:
            inner = enter_call(seen, functions[0])
            results = list_returned_nodes(functions[0][0])
            return self._one_of(map(inner.with_node, results), depth)
        if len(functions) > 1:
            return TestsRun(unclear=call)
        args = call.all_args
        owner = () if call.owner is None else (call.owner,)
        if name in KINDS and len(args) == 1:
            of = [infer_bound_class(seen.with_node(node), self._names) for node in owner]
            read = {*of} <= {"", "SysIdRoutine"}
            test = SysIdTest(name, self._direction(seen.with_node(args[0])), read=read)
            emptied = [one for node in owner for one in self._emptied(seen.with_node(node))]
            return TestsRun((test,), hindrances=tuple(emptied))
        return self._library(seen, name, owner, args, depth) or self._by_name(seen, name, args)

    def _library(
        self,
        seen: BoundNode,
        name: str,
        owner: tuple[Node, ...],
        args: tuple[Node, ...],
        depth: int,
    ) -> TestsRun | None:
        """What a library's method makes of the commands it is given; None if there are none."""
        asked = CONDITIONED.get(name)
        parts = (*owner, *args)
        if asked is not None:
            parts = (*owner, *args[:asked])
        several = [self.find_tests(seen.with_node(part), depth=depth) for part in parts]
        if name in DISCARDS:  # a function that only makes a command starts nothing
            several = [one for one in several if one.scheduled]
        found = join_tests_run(several)
        if not found.tests:
            return None
        first = next((at for at, one in enumerate(several) if one.tests), 0)
        hindrance = self._decorators.find_hindrance(seen, name, parts, first)
        if hindrance is not None:
            found = replace(found, hindrances=(*found.hindrances, hindrance))
        if asked is not None:
            found = self._conditioned(found, tuple(map(seen.with_node, args)), name, asked, depth)
        unclear = found.unclear if len(found.tests) > 1 else None
        return replace(
            found,
            unclear=unclear,
            scheduled=found.scheduled or name == "schedule",
            stopped=found.stopped or name in ENDED,
        )

    def _conditioned(
        self, found: TestsRun, args: tuple[BoundNode, ...], name: str, asked: int, depth: int
    ) -> TestsRun:
        """A command with the condition of a decorator, or of a choice between two commands."""
        condition = args[asked : asked + 1]
        second = asked > 1 and bool(args) and not self.find_tests(args[0], depth=depth).tests
        negated = name in EXCEPT or second
        truth = self._decorators.find_constant_truth(condition[0]) if condition else None
        if condition and truth is not None:  # it guards nothing
            if truth is not negated:
                return found
            kind = HindranceKind.CUT if name == "until" else HindranceKind.NEVER
            hindrance = make_hindrance(kind, name, condition[0].node)
            return replace(found, hindrances=(*found.hindrances, hindrance))
        if negated:
            return replace(found, exceptions=(*found.exceptions, *condition))
        return replace(found, conditions=(*found.conditions, *condition))

    def _emptied(self, routine: BoundNode) -> Iterator[Hindrance]:
        """Where the field of a routine is set to null after its declaration."""
        for one in find_definitions(routine, self._names):
            if isinstance(one.value, Null) and one.scope.functions:
                text = f"{get_last_name(routine.node)} = {one.value.place.text}"
                yield Hindrance(HindranceKind.EMPTIED, text)

    def _by_name(self, seen: BoundNode, name: str, args: tuple[Node, ...]) -> TestsRun:
        """A method of a class that is not in these files: only its name can tell."""
        kind = KIND.search(name)
        if kind is None or name[:1].isupper():
            return TestsRun()
        ways = [self._direction(seen.with_node(arg)) for arg in args] or [""]
        way = WAY.search(name)
        if way is not None:
            ways = ["forward" if way[1] else "reverse"]
        return TestsRun((SysIdTest("quasistatic" if kind[1] else "dynamic", ways[0], read=False),))

    def _direction(self, seen: BoundNode) -> str:
        seen = resolve_bound(seen, self._names)
        node = seen.node
        if isinstance(node, Choice):
            ways = [self._direction(seen.with_node(one)) for one in self._chosen(seen, node)]
            asked = resolve_bound(seen.with_node(node.condition), self._names)
            either = "any" if is_open_parameter(asked, self._names) else ""
            return ways[0] if len(ways) == 1 else either
        if is_open_parameter(seen, self._names):
            return "any"
        if isinstance(node, Name | Member):
            word = normalize_enum_constant(node.name)
            return word if word in DIRECTIONS else ""
        return ""


def join_tests_run(several: Iterable[TestsRun]) -> TestsRun:
    """What several commands together run, each test once."""
    found = list(several)
    return TestsRun(
        tuple(dict.fromkeys(test for one in found for test in one.tests)),
        tuple(condition for one in found for condition in one.conditions),
        tuple(condition for one in found for condition in one.exceptions),
        scheduled=any(one.scheduled for one in found),
        stopped=any(one.stopped for one in found),
        unclear=next((one.unclear for one in found if one.unclear is not None), None),
        either=any(one.either for one in found),
        hindrances=tuple(dict.fromkeys(each for one in found for each in one.hindrances)),
    )
