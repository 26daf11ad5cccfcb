"""Conditions that are always true or always false: ``() -> 1 > 2``, ``isTest() && false``.

A literal behind a name is no constant here. A team sets such a constant before a test and deploys,
so it serves as a switch.
"""

import operator
from collections.abc import Callable
from dataclasses import replace

from grader.robotcode.button_vocabulary import BOTH, EITHER, NOT, UNCHANGED, WRAPPERS
from grader.robotcode.closure import (
    BoundNode,
    enter_call,
    find_bound_return,
    resolve_bound,
    resolve_call,
)
from grader.robotcode.constant_folding import ConstantFolder
from grader.robotcode.ir import (
    Call,
    Choice,
    Function,
    Member,
    Name,
    Node,
    Opaque,
    Operation,
    Return,
)
from grader.robotcode.name_resolution import get_method_name
from grader.robotcode.symbol_table import SymbolTable

DEEPEST = 12  # conditions made of conditions
JOINING = {"&": "and", "&&": "and", "and": "and", "|": "or", "||": "or", "or": "or"}
NEGATING = frozenset({"not", "!", "~"})
COMPARISONS: dict[str, Callable[[float, float], bool]] = {
    **dict.fromkeys(("==", "is"), operator.eq),
    **dict.fromkeys(("!=", "is not", "^"), operator.ne),
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
}


class TruthFolder:
    """Works out which conditions never change.

    Args:
        names: the names of the program.
        measures: its constants.
    """

    def __init__(self, names: SymbolTable, measures: ConstantFolder) -> None:
        self._names = names
        self._measures = measures

    def fold(self, seen: BoundNode, *, depth: int = 0) -> bool | None:
        """The constant value of a condition, a supplier or a trigger; None if it may change."""
        before = seen.node
        if isinstance(before, Name) and before.name in seen.given:
            seen = seen.given[before.name]
            before = seen.node
        said = fold_literal(before)
        if said is not None or depth > DEEPEST:
            return said
        seen = resolve_bound(seen, self._names)
        node = seen.node
        if isinstance(node, Name | Member):
            return self._method(seen, depth + 1)
        if isinstance(node, Function):
            return self._returned(replace(seen, scope=seen.scope.within(node)), depth + 1)
        if isinstance(node, Call):
            return self._call(seen, node, depth + 1)
        if isinstance(before, Name | Member):  # a constant by its name
            return None
        return self._operation(seen, node, depth + 1)

    def _method(self, seen: BoundNode, depth: int) -> bool | None:
        """A method that is named, not called: ``this::enabled``."""
        call = seen.with_node(Call(seen.node.place, seen.node, ()))
        functions = resolve_call(call, self._names)
        if len(functions) != 1 or functions[0][0] in seen.scope.functions:
            return None
        return self._returned(enter_call(call, functions[0]), depth)

    def _returned(self, inside: BoundNode, depth: int) -> bool | None:
        returned = find_bound_return(inside)
        return None if returned is None else self.fold(returned, depth=depth)

    def _call(self, seen: BoundNode, call: Call, depth: int) -> bool | None:
        """What a call of a trigger's method, or of a function of these files, gives."""
        functions = resolve_call(seen, self._names)
        if functions:
            only = len(functions) == 1
            return self._returned(enter_call(seen, functions[0]), depth) if only else None
        name = get_method_name(call)
        args = call.all_args
        if name in WRAPPERS:
            return self.fold(seen.with_node(args[-1]), depth=depth) if args else None
        if isinstance(call.target, Name):  # a variable that holds a supplier: testing()
            held = resolve_bound(seen.with_node(call.target), self._names)
            return self.fold(held, depth=depth) if isinstance(held.node, Function) else None
        if not isinstance(call.target, Member):
            return None
        parts = [call.target.owner, *args]
        if name in BOTH | EITHER:
            return self._joined(seen, parts, "and" if name in BOTH else "or", depth)
        owner = (
            self.fold(seen.with_node(call.target.owner), depth=depth)
            if name in NOT | UNCHANGED
            else None
        )
        return not owner if owner is not None and name in NOT else owner

    def _choice(self, seen: BoundNode, node: Choice, depth: int) -> bool | None:
        said = self.fold(seen.with_node(node.condition), depth=depth)
        one, other = (
            self.fold(seen.with_node(part), depth=depth) for part in (node.one, node.other)
        )
        if said is None:
            return one if one is other else None
        return one if said else other

    def _operation(self, seen: BoundNode, node: Node, depth: int) -> bool | None:
        """A condition made of others, or a comparison of constants."""
        if not isinstance(node, Operation | Opaque):
            return self._choice(seen, node, depth) if isinstance(node, Choice) else None
        parts = [part for part in node.parts if not isinstance(part, Return)]
        sign = find_operator(node)
        if sign in {"and", "or"} and len(parts) > 1:
            return self._joined(seen, parts, sign, depth)
        if len(parts) == 2 and sign in COMPARISONS:  # noqa: PLR2004 - left and right
            return self._compared(seen, parts, sign, depth)
        if len(parts) != 1:
            return None
        said = self.fold(seen.with_node(parts[0]), depth=depth)
        if said is None or sign not in NEGATING:
            return said if isinstance(node, Opaque) and not sign else None
        return not said

    def _joined(self, seen: BoundNode, parts: list[Node], sign: str, depth: int) -> bool | None:
        """Several conditions of which all, or one, must hold."""
        decides = sign == "or"  # the value of one part that decides for all
        found = [self.fold(seen.with_node(part), depth=depth) for part in parts]
        if decides in found:
            return decides
        return None if None in found else not decides

    def _compared(self, seen: BoundNode, parts: list[Node], sign: str, depth: int) -> bool | None:
        truths = [self.fold(seen.with_node(part), depth=depth) for part in parts]
        if truths[0] is not None and truths[1] is not None:
            return COMPARISONS[sign](truths[0], truths[1])
        if any(isinstance(part, Name | Member) for part in parts):
            return None
        found = [self._measures.fold(part, seen.scope) for part in parts]
        if found[0] is None or found[1] is None:
            return None
        return COMPARISONS[sign](found[0].value, found[1].value)


def fold_literal(node: Node) -> bool | None:
    """The truth of a literal; None for anything else."""
    text = node.place.text.lower().removeprefix("boolean.")
    return {"true": True, "false": False}.get(text)


def find_operator(node: Operation | Opaque) -> str:
    """The operator of a node: ``and``, ``or``, ``not`` or a symbol like ``==``; empty if unknown.

    Python's keywords are not in the parsed node, so they are read from its source text.
    """
    first, *more = node.parts or (node,)
    source = node.place.source
    if isinstance(node, Operation) and node.sign != "?":
        return JOINING.get(node.sign, node.sign)
    if not more:
        said = source[node.place.start : first.place.start].decode("utf-8", errors="replace")
        return "not" if said.strip(" (") in {"not", "~"} else ""
    said = source[first.place.end : more[0].place.start].decode("utf-8", errors="replace")
    said = " ".join(said.strip(" ()\n\t\\").split())
    return said if said in COMPARISONS else JOINING.get(said, "")
