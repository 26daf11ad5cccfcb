"""A syntax node with its scope and bound arguments, and names resolved from there."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from grader.robotcode.ir import (
    Call,
    Cast,
    Element,
    Function,
    FunctionParameter,
    Member,
    Name,
    Node,
    Reference,
    Self,
)
from grader.robotcode.name_resolution import (
    MOST_STEPS,
    Method,
    find_called_functions,
    find_class,
    find_single_return,
    get_simple_type_name,
    infer_type,
    infer_type_from,
)
from grader.robotcode.scope import Definition, Scope, find_only_value
from grader.robotcode.symbol_table import SymbolTable

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True)
class BoundNode:
    """A syntax node, its scope, and the arguments that the parameters around it were given."""

    node: Node
    scope: Scope
    given: "Mapping[str, BoundNode]" = field(default_factory=dict)

    def with_node(self, node: Node) -> "BoundNode":
        """Another node in the same scope, with the same arguments."""
        return replace(self, node=node)


def resolve_bound(seen: BoundNode, names: SymbolTable) -> BoundNode:
    """Resolve variables, parameters and fields to their values, as far as possible."""
    for _ in range(MOST_STEPS):
        node = seen.node
        if isinstance(node, Cast):
            seen = seen.with_node(node.value)
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
    found = find_only_value(find_definitions(seen, names))
    if found is None or isinstance(found[0], FunctionParameter | Element | Function):
        return None
    here, there = seen.scope.functions[:1], found[1].functions[:1]
    return BoundNode(*found, seen.given if here == there else {})


def find_definitions(seen: BoundNode, names: SymbolTable) -> Sequence[Definition]:
    """Where a variable or a field, of whatever object, gets its values."""
    found = names.find_definitions(seen.node, seen.scope)
    if found or not isinstance(seen.node, Member):
        return found
    owner = resolve_bound(seen.with_node(seen.node.owner), names)
    home = find_class(owner.node, owner.scope, names)
    return names.find_fields(home).get(seen.node.name, ()) if home and home.classes else ()


def resolve_call(seen: BoundNode, names: SymbolTable) -> list[Method]:
    """The functions of these files that a call may mean."""
    call = seen.node
    if not isinstance(call, Call):
        return []
    owner = None
    if isinstance(call.target, Member):
        through = resolve_bound(seen.with_node(call.target.owner), names)
        if not isinstance(through.node, Self):
            owner = (through.node, through.scope)
        if owner is not None and find_class(*owner, names) is None:
            owner = None  # declared by its type only: let the variable itself tell
    return find_called_functions(call, seen.scope, names, owner=owner)


def enter_call(seen: BoundNode, method: Method) -> BoundNode:
    """The body of a called function, with the call's arguments bound."""
    function, scope = method
    given: dict[str, BoundNode] = {}
    if isinstance(seen.node, Call):
        pairs = zip(function.parameters, seen.node.args, strict=False)
        given = {one.name: seen.with_node(arg) for one, arg in pairs}
        given |= {word: seen.with_node(arg) for word, arg in seen.node.named}
    return BoundNode(function, scope, given)


def infer_bound_class(seen: BoundNode, names: SymbolTable) -> str:
    """The class of an object, by its own name; empty if unknown."""
    found = infer_type(seen.node, seen.scope, names)
    return get_simple_type_name(
        found or infer_type_from(tuple(find_definitions(seen, names)), names)
    )


def is_open_parameter(seen: BoundNode, names: SymbolTable) -> bool:
    """Whether a name is a parameter without an argument so far."""
    if not isinstance(seen.node, Name):
        return False
    found = names.find_local(seen.node.name, seen.scope)
    return any(isinstance(one.value, FunctionParameter) for one in found)


def find_bound_return(inside: BoundNode) -> BoundNode | None:
    """The value that a function's body returns; None if there may be several."""
    function = inside.node
    returned = find_single_return(function) if isinstance(function, Function) else None
    return None if returned is None else inside.with_node(returned)


def list_called_functions(node: Node, scope: Scope, names: SymbolTable) -> list[Function]:
    """The functions that some node calls; a call of itself does not count."""
    if isinstance(node, Call):
        found = find_called_functions(node, scope, names)
    elif isinstance(node, Member):
        found = find_called_functions(Call(node.place, node, ()), scope, names)
    else:
        return []
    return [function for function, _ in found if function not in scope.functions]
