"""Whether a field of an object still holds the value that the constructor stored in it."""

from collections.abc import Iterator

from grader.robotcode.ir import Assign, Call, Class, Function, Node, Null, iter_nodes
from grader.robotcode.name_resolution import find_called_functions
from grader.robotcode.scope import Scope
from grader.robotcode.symbol_table import SymbolTable

CONSTRUCTORS = frozenset({"<init>", "__init__"})
DEEPEST = 5  # methods that the constructor calls, one inside the other


def find_line_that_clears(value: Call, home: Scope, names: SymbolTable) -> int:
    """The line that sets a field to null after a value was stored in it; 0 if none.

    Args:
        value: what the field was given.
        home: the class that has the field.
        names: the names of the program.

    Returns:
        The line; 0 if the field keeps something, or no field was given the value.
    """
    if not home.classes:
        return 0
    field, lost = "", 0
    for node, scope in _construction(home, names):
        name = names.find_field_name(node.target, scope)
        if name and node.value is not None and _holds(node.value, value):
            field, lost = name, 0
        elif name and name == field:
            lost = node.place.line if isinstance(node.value, Null) else 0
    return lost


def _holds(node: Node, value: Call) -> bool:
    """Whether a value is given as it is, or through what is made around it."""
    return any(one is value for one in iter_nodes(node, but=(Function, Class)))


def _construction(home: Scope, names: SymbolTable) -> Iterator[tuple[Assign, Scope]]:
    """The assignments that make an object, in their order: its fields first, then a constructor."""
    body = home.classes[-1].body
    fields = [node for node in body if not isinstance(node, Function | Class)]
    yield from _assignments(tuple(fields), home, names, DEEPEST)
    for node in body:
        if isinstance(node, Function) and node.name in CONSTRUCTORS:
            yield from _assignments(node.body, home.within(node), names, DEEPEST)


def _assignments(
    nodes: tuple[Node, ...], scope: Scope, names: SymbolTable, depth: int
) -> Iterator[tuple[Assign, Scope]]:
    for node in iter_nodes(*nodes, but=(Function, Class)):
        if isinstance(node, Assign):
            yield node, scope
        elif isinstance(node, Call) and depth > 0:
            functions = find_called_functions(node, scope, names)
            if len(functions) != 1:
                continue
            function, inside = functions[0]
            if inside.home == scope.home and function not in scope.functions:
                yield from _assignments(function.body, inside, names, depth - 1)
