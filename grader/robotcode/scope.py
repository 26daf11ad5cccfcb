"""Scopes: the file, classes and functions around a piece of code, and the names assigned there."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from grader.robotcode.ir import (
    Assign,
    Class,
    Element,
    Function,
    Loop,
    Module,
    Name,
    Node,
    iter_nodes,
)

MOST_FUNCTIONS = 20  # functions one inside the other whose variables are still seen


@dataclass(frozen=True)
class Scope:
    """The scope of a piece of code: its file, and the classes and functions around it."""

    module: Module
    classes: tuple[Class, ...] = ()
    functions: tuple[Function, ...] = ()

    @property
    def home(self) -> "Scope":
        """The class around it, without the functions."""
        return replace(self, functions=())

    @property
    def homes(self) -> "tuple[Scope, ...]":
        """The classes around it, the innermost first."""
        counts = range(len(self.classes), 0, -1)
        return tuple(Scope(self.module, self.classes[:count]) for count in counts)

    def within(self, node: Node) -> "Scope":
        """The scope inside a node of this scope."""
        if isinstance(node, Class):
            return Scope(self.module, (*self.classes, node))
        if isinstance(node, Function):
            return replace(self, functions=(*self.functions, node)[-MOST_FUNCTIONS:])
        return self


@dataclass(frozen=True)
class Definition:
    """One place where a variable gets its value.

    Args:
        value: what it gets; for a parameter the Parameter itself, for the variable of a loop an
            Element of what it runs over; None for a bare declaration.
        scope: where the value stands.
        type: the declared type; empty if none.
    """

    value: Node | None
    scope: Scope
    type: str = ""


Definitions = tuple[Definition, ...]


def find_only_value(definitions: Sequence[Definition]) -> tuple[Node, Scope] | None:
    """The one value that a variable gets, with its scope; None if it gets none or several."""
    valued = [(one.value, one.scope) for one in definitions if one.value is not None]
    return valued[0] if len(valued) == 1 else None


def walk_with_scopes(nodes: tuple[Node, ...], scope: Scope) -> Iterator[tuple[Node, Scope]]:
    """All nodes in and under some, each with the scope it stands in, in the order of the text."""
    waiting = [(node, scope) for node in reversed(nodes)]
    while waiting:
        node, around = waiting.pop()
        yield node, around
        within = around.within(node)
        waiting.extend((part, within) for part in reversed(node.parts))


def collect_bindings(nodes: tuple[Node, ...], scope: Scope) -> dict[str, Definitions]:
    """The names that get a value in a body of code, not counting those of functions inside it.

    In Java an assignment without a declaration is to a field, and brings no name into being.
    """
    found: dict[str, list[Definition]] = {}
    declared = set()
    for node in iter_nodes(*nodes, but=(Function, Class)):
        if isinstance(node, Assign) and isinstance(node.target, Name):
            name = node.target.name
            found.setdefault(name, []).append(Definition(node.value, scope, node.type))
            if node.declares or scope.module.language == "python":
                declared.add(name)
        elif isinstance(node, Loop):
            element = Element(node.collection.place, node.collection, node.collection)
            for name in node.variables:
                found.setdefault(name, []).append(Definition(element, scope))
            declared.update(node.variables)
        elif isinstance(node, Function) and node.name and scope.module.language == "python":
            found.setdefault(node.name, []).append(Definition(node, scope))
            declared.add(node.name)
    return {name: tuple(found[name]) for name in found if name in declared}
