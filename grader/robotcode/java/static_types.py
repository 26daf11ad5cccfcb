"""Types that are known before a program runs: those of names, constants and operations.

A type that cannot be told is empty, and fits everywhere. What does not fit is found when the
program runs; only a number that would lose its fraction is refused before.
"""

import functools
from collections.abc import Sequence
from typing import Any

from tree_sitter import Node

from grader.robotcode.java import type_names, values
from grader.robotcode.java.classes import NUMBERS, WIDENS, JavaClass
from grader.robotcode.java.scope import Code, Frame, kind_of
from grader.robotcode.java.syntax import At
from grader.robotcode.java.values import BOXES, PRIMITIVES
from grader.robotcode.library.base import Fake

SMALL = frozenset({"byte", "short", "char"})  # what an int becomes in them is unknown
KINDS = {float: "double", int: "int", bool: "boolean", str: "String"}


class StaticTypes:
    """The types in one method.

    Args:
        owner: the class that the method belongs to.
        frame: its local variables.
    """

    def __init__(self, owner: JavaClass, frame: Frame) -> None:
        self.owner, self.frame = owner, frame
        self.program = owner.unit.program

    def at(self, node: Node) -> At:
        """The place of a node in the source, for messages."""
        return self.owner.unit.source.at(node)

    def resolve(self, name: str) -> Any:
        """The class of a name, or None."""
        return self.program.resolve(name, self.owner, self.frame)

    def find_type(self, node: Node | None) -> Any:
        """The class that a type names; an unknown one is reported as an error."""
        if node is None:
            return None
        name = kind_of(node)
        if not self.erased(name) or name.rstrip("[]") in PRIMITIVES | {"var", "void"}:
            return None
        return self.program.resolve_or_report(name, self.owner, self.at(node), self.frame)

    def erased(self, kind: str) -> str:
        """A type's name, empty if it is a type parameter."""
        name = kind.rstrip("[]")
        frame: Frame | None = self.frame
        while frame is not None:
            if name in frame.variables:
                return ""
            frame = frame.outer
        return erased_in(self.owner, kind)

    def translate_type(self, owner: JavaClass, kind: str) -> str:
        """A type that another class names, by its name here; empty if that is another here."""
        kind = erased_in(owner, kind)
        name = kind.rstrip("[]")
        if owner is self.owner or name in PRIMITIVES or name in {"String", "void", ""}:
            return kind
        return kind if self.resolve(name) is self.program.resolve(name, owner) else ""

    def find_result_type(self, found: Any) -> str:
        """The result type of a method of the program; empty if it is unknown."""
        overloads = getattr(found, "overloads", None)
        if overloads is None or overloads.inherited is not None:
            return ""
        results = {self.translate_type(one.owner, one.returns) for one in overloads.methods}
        return results.pop() if len(results) == 1 else ""

    def describe_unknown_field(self, cls: JavaClass, name: str) -> str:
        """What to say where a class has no field of a name."""
        return unknown_name("field", name, member_names(cls), cls.name)

    def explain_refusal(self, kind: str, code: Code) -> str:
        """The error of javac for a number in place of another type; empty if it is allowed."""
        source, target = BOXES.get(code.kind, code.kind), BOXES.get(kind, kind)
        refusal = self.explain_unrelated_types(kind, code)
        if refusal or not (source in PRIMITIVES and target in PRIMITIVES) or source == target:
            return refusal
        if kind in WIDENS[source] or (target in SMALL and source in SMALL | {"int"}):
            return ""
        return f"incompatible types: possible lossy conversion from {code.kind} to {kind}"

    @staticmethod
    def explain_unrelated_types(kind: str, code: Code) -> str:
        """What javac says of a type that no cast converts to another; empty if one does."""
        both = {BOXES.get(code.kind, code.kind), BOXES.get(kind, kind)}
        if code.kind == "void" and kind:
            return "a method that returns nothing gives no value"
        known = both <= {"String", *PRIMITIVES} and len(both) > 1
        if known and both & {"String", "boolean"}:
            return f"incompatible types: {code.kind} cannot be converted to {kind}"
        return ""


def has_known_members(cls: Any) -> bool:
    """Whether all members of a class, and all classes above it, are known."""
    if isinstance(cls, JavaClass):
        above = [one for up in cls.ancestors() for one in (up.parent, *up.interfaces)]
        if any(up.uses_lombok for up in cls.ancestors()):
            return False
        return all(
            isinstance(one, JavaClass) or one is None or has_known_members(one) for one in above
        )
    return isinstance(cls, type) and issubclass(cls, Fake) and cls.fake_complete


def unknown_name(what: str, name: str, known: Sequence[str], label: str) -> str:
    """The error for an unknown name, with the most similar known one."""
    lacks = f": {label} has none" if label else ": nothing here has it"
    return f"unknown {what} {name}{type_names.did_you_mean(name, known) or lacks}"


def member_names(cls: Any) -> list[str]:
    """The names of all members of a class."""
    if isinstance(cls, JavaClass):
        names = [name for one in cls.ancestors() for name in (*one.fields, *one.nested)]
        names += [one.name for up in cls.ancestors() for one in up.methods]
        base = cls.library_base
        return names + (member_names(base) if isinstance(base, type) else [])
    listed = (*dir(cls), *getattr(cls, "fake_others", ()))
    return [one.rstrip("_") for one in listed if not one.startswith(("_", "fake_"))]


def erased_in(owner: JavaClass, kind: str) -> str:
    """A type as a class's text has it, empty where it is a type parameter."""
    one: JavaClass | None = owner
    while one is not None:
        if kind.rstrip("[]") in one.variables:
            return ""
        one = one.outer
    return kind


def promoted(sign: str, left: str, right: str) -> str:
    """The type of an operation on two types; empty if it cannot be told."""
    if sign == "+" and "String" in (left, right):
        return "String"
    if left == right == "boolean":
        return "boolean"
    pair = ["int" if one in SMALL else one for one in (left, right)]
    if any(one not in NUMBERS for one in pair):
        return "double" if "double" in pair and "" not in pair else ""
    return max(pair, key=NUMBERS.index)


def join_codes(codes: Sequence[Code]) -> str:
    """The type of a value that is one of several, all of which are converted to it."""
    kinds = {BOXES.get(one.kind, one.kind) for one in codes}
    if len({one.kind for one in codes}) == 1:
        return codes[0].kind
    if "null" in kinds and len(kinds) == 2:  # noqa: PLR2004 - null and one type
        kind = max(kinds - {"null"})
        return next((box for box, one in BOXES.items() if one == kind), kind)
    if not (kinds <= {*NUMBERS, "char"} or kinds == {"boolean"}):
        return ""
    kind = functools.reduce(lambda a, b: promoted("+", a, b), sorted(kinds))
    for one in codes:
        one.run = lambda env, run=one.run: values.cast(kind, run(env))
    return kind
