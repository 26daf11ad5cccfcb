"""What WPILib's decorators and compositions do to a command: whether it still starts and lasts.

One that is not known here may do anything. The command is then not certain to run.
"""

import math

from grader.robotcode.binding_facts import Hindrance, HindranceKind
from grader.robotcode.button_vocabulary import (
    BEFORE,
    CHAINED,
    CONDITIONED,
    DEADLINES,
    DISCARDS,
    ENDLESS,
    HARMLESS,
    INSTANT,
    RACES,
    WAITING,
    WAITING_UNTIL,
)
from grader.robotcode.closure import BoundNode, resolve_bound, resolve_call
from grader.robotcode.constant_folding import ConstantFolder
from grader.robotcode.constant_truth import TruthFolder
from grader.robotcode.ir import Call, Function, Member, Node
from grader.robotcode.name_resolution import get_method_name
from grader.robotcode.symbol_table import SymbolTable

WHOLE = 10.0  # [s] a test's own timeout, in WPILib's defaults and in the exercises
LONGEST_WAIT = 5.0  # [s] longer, and whoever holds the button waits in vain


class Decorators:
    """Interprets WPILib's command decorators: whether a decorated command starts and lasts.

    Args:
        names: the names of the program.
        measures: its constants.
    """

    def __init__(self, names: SymbolTable, measures: ConstantFolder) -> None:
        self._names = names
        self._measures = measures
        self._truth = TruthFolder(names, measures)

    def find_constant_truth(self, condition: BoundNode) -> bool | None:
        """The constant value of a condition; None if it may change."""
        return self._truth.fold(condition)

    def find_hindrance(
        self, seen: BoundNode, name: str, parts: tuple[Node, ...], first: int
    ) -> Hindrance | None:
        """Why a command may not start, or not last; None if nothing keeps it from that.

        Args:
            seen: the call.
            name: the method that is called.
            parts: what it is called on, if anything, and its arguments.
            first: which of them runs the first test.
        """
        if name in CONDITIONED or name in HARMLESS or name in DISCARDS:
            return None
        call = seen.node
        if name == "withTimeout":
            return self._cut(call, self._seconds(seen, parts[1:]))
        if name in BEFORE:
            return self._waits(seen, name, parts, first)
        if name in RACES | DEADLINES:
            return self._raced(seen, name, parts, first)
        return Hindrance(HindranceKind.UNREAD, _shown(call))

    def _waits(
        self, seen: BoundNode, name: str, parts: tuple[Node, ...], first: int
    ) -> Hindrance | None:
        """What a test has to wait for that comes before it."""
        before = parts[1:] if name == "beforeStarting" else parts[:first]
        for part in before:
            lasts = self._duration(seen.with_node(part))
            if lasts is not None and lasts > LONGEST_WAIT:
                return make_hindrance(HindranceKind.NEVER, "", part)
        return None

    def _raced(
        self, seen: BoundNode, name: str, parts: tuple[Node, ...], first: int
    ) -> Hindrance | None:
        """Another command whose end is the end of the test, too."""
        call = seen.node
        static = isinstance(call, Call) and isinstance(call.target, Member) and name not in CHAINED
        several = [*range(1 if static else 0, len(parts))]
        if name in DEADLINES:
            several = several[:1]
        for at in several:
            if at != first:
                found = self._cut(parts[at], self._duration(seen.with_node(parts[at])))
                if found is not None:
                    return found
        return None

    def _cut(self, node: Node, lasts: float | None) -> Hindrance | None:
        """What ends a test after some time; None if the test is over by then."""
        if lasts is None:
            return Hindrance(HindranceKind.UNREAD, _shown(node))
        return None if lasts >= WHOLE else make_hindrance(HindranceKind.CUT, "", node)

    def _duration(self, seen: BoundNode) -> float | None:
        """How long a command lasts [s]; None if unknown."""
        seen = resolve_bound(seen, self._names)
        node = seen.node
        if isinstance(node, Function):  # a function that runs once
            return 0.0
        if not isinstance(node, Call) or resolve_call(seen, self._names):
            return None
        name, args = get_method_name(node), node.all_args
        if name in INSTANT | ENDLESS:
            return 0.0 if name in INSTANT else math.inf
        if name in WAITING:
            return self._seconds(seen, args)
        if name in WAITING_UNTIL and args:
            truth = self._truth.fold(seen.with_node(args[0]))
            return 0.0 if truth else math.inf if truth is False else None
        return None

    def _seconds(self, seen: BoundNode, args: tuple[Node, ...]) -> float | None:
        found = self._measures.fold(args[0], seen.scope) if args else None
        return None if found is None else found.value


def make_hindrance(kind: HindranceKind, method: str, node: Node) -> Hindrance:
    """A hindrance by its source text, with the method that it is an argument of."""
    text = f"{method}({node.place.text})" if method else _shown(node)
    return Hindrance(kind, text)


def _shown(node: Node) -> str:
    """A call without what it is called on: ``withTimeout(0.1)``."""
    target = node.target if isinstance(node, Call) else None
    return target.place.text if isinstance(target, Member) else node.place.text
