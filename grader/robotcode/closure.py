"""A piece of code together with what its parameters stand for, and names followed from there."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from grader.robotcode.ir import (
    Call,
    Cast,
    Class,
    Element,
    Function,
    FunctionParameter,
    Member,
    Name,
    Node,
    Reference,
    Return,
    Self,
    iter_nodes,
)
from grader.robotcode.name_resolution import MOST_STEPS, Method, called_functions, class_of
from grader.robotcode.scope import Definition, Scope
from grader.robotcode.symbol_table import SymbolTable

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True)
class BoundNode:
    """A node, where it stands, and what the parameters around it were given."""

    node: Node
    scope: Scope
    given: "Mapping[str, BoundNode]" = field(default_factory=dict)

    def at(self, node: Node) -> "BoundNode":
        """Another node of the same place."""
        return replace(self, node=node)


def resolve_bound(seen: BoundNode, names: SymbolTable) -> BoundNode:
    """Follow variables, parameters and fields to what they stand for, as far as can be told."""
    for _ in range(MOST_STEPS):
        node = seen.node
        if isinstance(node, Cast):
            seen = seen.at(node.value)
        elif isinstance(node, Name) and node.name in seen.given:
            seen = seen.given[node.name]
        elif isinstance(node, Name | Member) and not isinstance(node, Reference):
            found = _value(seen, names)
            if found is None:
                return seen
            seen = found
        else:
            return seen
    return seen


def _value(seen: BoundNode, names: SymbolTable) -> BoundNode | None:
    """The one value of a variable; None if it has none or several, or is a parameter."""
    valued = [one for one in definitions(seen, names) if one.value is not None]
    if len(valued) != 1 or isinstance(valued[0].value, FunctionParameter | Element | Function):
        return None
    one = valued[0]
    here, there = seen.scope.functions[:1], one.scope.functions[:1]
    return BoundNode(one.value or seen.node, one.scope, seen.given if here == there else {})


def definitions(seen: BoundNode, names: SymbolTable) -> Sequence[Definition]:
    """Where a variable or a field, of whatever object, gets its values."""
    found = names.definitions(seen.node, seen.scope)
    if found or not isinstance(seen.node, Member):
        return found
    owner = resolve_bound(seen.at(seen.node.owner), names)
    home = class_of(owner.node, owner.scope, names)
    return names.fields(home).get(seen.node.name, ()) if home and home.classes else ()


def functions_of(seen: BoundNode, names: SymbolTable) -> list[Method]:
    """The functions of these files that a call may mean."""
    call = seen.node
    if not isinstance(call, Call):
        return []
    owner = None
    if isinstance(call.target, Member):
        through = resolve_bound(seen.at(call.target.owner), names)
        if not isinstance(through.node, Self):
            owner = (through.node, through.scope)
        if owner is not None and class_of(*owner, names) is None:
            owner = None  # declared by its type only: let the variable itself tell
    return called_functions(call, seen.scope, names, owner=owner)


def enter_call(seen: BoundNode, method: Method) -> BoundNode:
    """The inside of a function that a call gives its arguments to."""
    function, scope = method
    given: dict[str, BoundNode] = {}
    if isinstance(seen.node, Call):
        pairs = zip(function.parameters, seen.node.args, strict=False)
        given = {one.name: seen.at(arg) for one, arg in pairs}
        given |= {word: seen.at(arg) for word, arg in seen.node.named}
    return BoundNode(function, scope, given)


def returned_nodes(function: Function) -> list[Node]:
    """Everything a function may hand back."""
    found = iter_nodes(*function.body, but=(Function, Class))
    return [node.value for node in found if isinstance(node, Return)]


def functions_named(node: Node, scope: Scope, names: SymbolTable) -> list[Function]:
    """The functions that some node calls; a call of itself does not count."""
    if isinstance(node, Call):
        found = called_functions(node, scope, names)
    elif isinstance(node, Member):
        found = called_functions(Call(node.place, node, ()), scope, names)
    else:
        return []
    return [function for function, _ in found if function not in scope.functions]
