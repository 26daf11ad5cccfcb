"""The methods that make the commands of SysId's tests, and who may call them."""

import re
from collections.abc import Iterator, Sequence

from grader.robotcode.binding_facts import Factory
from grader.robotcode.closure import BoundNode
from grader.robotcode.commands import CommandReader
from grader.robotcode.ir import Class, Function, Member, Node, Self
from grader.robotcode.name_resolution import find_class, infer_type, list_returned_nodes
from grader.robotcode.scope import Scope
from grader.robotcode.symbol_table import SymbolTable


def find_factories(
    every: Sequence[tuple[Node, Scope]], names: SymbolTable, commands: CommandReader
) -> Iterator[Factory]:
    """The methods that make a test's command, of the classes here and of those they own."""
    main = names.main
    homes = {node: scope.within(node) for node, scope in every if isinstance(node, Class)}
    for home in [*homes.values()]:
        for name in names.find_fields(home):
            place = home.classes[-1].place
            node = Member(place, Self(place), name)
            type_ = infer_type(node, home, names)
            owned = find_class(node, home, names) if type_ else None
            if owned is not None and owned.classes:
                homes.setdefault(owned.classes[-1], owned)
    for home in homes.values():
        for method in names.list_members(home):
            if not isinstance(method, Function):
                continue
            line = method.place.line if home.module is main else 0
            public = is_public(method, home.module.language)
            seen = BoundNode(method, home.within(method))
            for value in list_returned_nodes(method):
                for test in commands.find_tests(seen.with_node(value)).tests:
                    if test.read:
                        yield Factory(test, method.name, public, line)


def is_public(function: Function, language: str) -> bool:
    """Whether any other class may call a method."""
    if language == "python":
        return not function.name.startswith("_")
    return bool(re.search(r"\bpublic\b", _header(function)))


def is_private(function: Function, language: str) -> bool:
    """Whether no other class may call a method."""
    if language == "python":
        return function.name.startswith("_") and not function.name.startswith("__")
    return bool(re.search(r"\bprivate\b", _header(function)))


def _header(function: Function) -> str:
    """What stands before a Java method's name."""
    place = function.place
    text = place.source[place.start : place.end].decode("utf-8", errors="replace")
    return re.split(rf"\b{re.escape(function.name)}\s*\(", text, maxsplit=1)[0]
