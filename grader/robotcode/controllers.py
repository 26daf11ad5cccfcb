"""The controllers of a program, and what they do beside starting SysId's tests."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from grader.robotcode.binding_facts import Controller
from grader.robotcode.closure import BoundNode, list_called_functions
from grader.robotcode.ir import Call, Member, Name, Node
from grader.robotcode.scope import Scope
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.triggers import Triggers


def find_controllers(
    every: Sequence[tuple[Node, Scope]], names: SymbolTable, triggers: Triggers
) -> tuple[Controller, ...]:
    """The controllers of the file, with what else is done with their buttons and sticks."""
    found: dict[str, Controller] = {}
    for node, scope in every:
        seen = BoundNode(node, scope)
        if isinstance(node, Name | Member):
            name = triggers.find_controller(seen)
            if name and name not in found:
                found[name] = Controller(name, triggers.find_port(seen))
    for node, name in _other_uses(every, names, triggers):
        one = found.setdefault(name, Controller(name, None))
        found[name] = replace(one, uses=(*one.uses, (node.place.text, node.place.line)))
    return tuple(found.values())


def _other_uses(
    every: Sequence[tuple[Node, Scope]], names: SymbolTable, triggers: Triggers
) -> Iterator[tuple[Node, str]]:
    """Where a controller does something that no test's trigger asks for."""
    asked = triggers.asked
    mine = asked | {node.target for node in asked if isinstance(node, Call)}
    for node, scope in every:
        seen = BoundNode(node, scope)
        if isinstance(node, Member) and node not in mine:
            name = triggers.find_controller(seen.with_node(node.owner))
            if name:
                yield node, name
        elif (
            isinstance(node, Call)
            and node not in asked
            and not list_called_functions(node, scope, names)
        ):
            handed = (triggers.find_controller(seen.with_node(arg)) for arg in node.args)
            yield from ((node, name) for name in handed if name)
