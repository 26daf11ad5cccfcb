"""Where a program keeps its constants: the fields of its classes, with the values they have now.

The value comes from the program that runs; how it is written, and on which lines, from its text.
"""

import ast
import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from grader.robotcode.bench.routine_run import Bench, StoppedError
from grader.robotcode.bench.simulation import walk_fields
from grader.robotcode.python.imports import rename

Field = tuple[str, Any, str, int, int]  # name, value, way of writing, first and last line
Holder = tuple[str, str, tuple[int, int], list[Field]]  # class, text of its file, lines, fields


def list_java_holders(bench: Bench) -> Iterator[Holder]:
    """The classes of a Java program that were used, or are in its main file, with their fields."""
    subject = bench.subject
    objects = subject._list_instances()
    for java in subject._list_classes():
        if java.unit is subject.program.unit:
            with contextlib.suppress(StoppedError):  # what it did not reach has no value
                bench.guard(java.initialize)
        elif java.state == "new":  # nothing used it
            continue
        held = getattr(objects.get(java), "__dict__", {})
        fields = []
        for one in java.fields.values():
            node = one.value
            last = one.at if node is None else max(one.at, node.end_point[0] + 1)
            written = "" if node is None else (node.text or b"").decode()
            value = (java.statics if one.static else held).get(one.key)
            fields.append((one.name, value, written, int(one.at), int(last)))
        lines = (int(java.at), java.node.end_point[0] + 1)
        yield java.name, java.unit.source.text, lines, fields


def list_python_holders(bench: Bench) -> Iterator[Holder]:
    """The modules of a Python program and their classes, with their attributes."""
    subject = bench.subject
    for module in subject.modules:
        text = Path(module.__file__).read_bytes().decode("utf-8-sig", "replace")
        objects = {type(one): one for _, _, one in walk_fields([subject.instance, vars(module)])}
        waiting: list[tuple[Any, Any]] = [(ast.parse(text), module)]
        for node, place in waiting:  # grows on the way
            held = objects.get(place, place)
            fields = [
                (target, getattr(held, rename(target), None), written, first, end)
                for target, written, first, end in _list_assignments(node)
            ]
            last = getattr(node, "end_lineno", 0)
            yield getattr(node, "name", ""), text, (getattr(node, "lineno", 1), last), fields
            inner = [one for one in node.body if isinstance(one, ast.ClassDef)]
            waiting += [(one, getattr(place, rename(one.name), None)) for one in inner]


def _list_assignments(node: ast.Module | ast.ClassDef) -> Iterator[tuple[str, str, int, int]]:
    """Name, value and lines of the assignments in a class or module, ``self.name`` included."""
    inside = [ast.walk(one) for one in node.body if isinstance(one, ast.FunctionDef)]
    for one in (*node.body, *(part for walk in inside for part in walk)):
        if isinstance(one, ast.Assign | ast.AnnAssign):
            written = ast.unparse(one.value) if one.value else ""
            for target in getattr(one, "targets", [getattr(one, "target", None)]):
                own = isinstance(target, ast.Attribute) and ast.unparse(target.value) == "self"
                if own or (isinstance(target, ast.Name) and one in node.body):
                    name = target.attr if own else target.id
                    yield name, written, one.lineno, one.end_lineno or one.lineno
