"""The small syntax that Java and Python are both brought to, so that what follows is written once.

Only what a SysIdRoutine is made of has a kind of its own: names, calls, numbers, functions,
assignments, classes. All other code is Opaque, or a Branch if it may not run: looked through for
calls, never interpreted.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from grader.robotcode.facts import ParseProblem

LONGEST = 200  # [characters] of source text shown to a learner


@dataclass(frozen=True, eq=False)
class SourceSpan:
    """A stretch of one file.

    Args:
        source: the file's text in UTF-8.
        start, end: [bytes] where the stretch begins and ends in it.
        line: the line it begins on, from 1.
    """

    source: bytes
    start: int
    end: int
    line: int

    @property
    def last_line(self) -> int:
        """The line on which it ends."""
        return self.line + self.source.count(b"\n", self.start, self.end)

    @property
    def text(self) -> str:
        """The source text on one line."""
        stretch = self.source[self.start : min(self.end, self.start + 4 * LONGEST)]
        said = " ".join(stretch.decode("utf-8", errors="replace").split())
        said = re.sub(r"(?<=\() | (?=[).,])", "", said)
        return said if len(said) <= LONGEST else said[: LONGEST - 1] + "…"


@dataclass(frozen=True, eq=False)
class Node:
    """A piece of code. Nodes are equal only to themselves."""

    place: SourceSpan

    @cached_property
    def parts(self) -> tuple["Node", ...]:
        """The nodes directly inside, in the order of the fields."""
        names: tuple[str, ...] = self.__match_args__[1:]
        return tuple(node for name in names for node in _nodes(getattr(self, name)))


def _nodes(value: object) -> Iterator[Node]:
    """The nodes a field holds: one, several, or one beside a keyword."""
    if isinstance(value, Node):
        yield value
    elif isinstance(value, tuple):
        for item in value:
            yield from _nodes(item)


@dataclass(frozen=True, eq=False)
class Number(Node):
    """A number; ``integer`` decides how Java divides it."""

    value: float
    integer: bool


@dataclass(frozen=True, eq=False)
class Text(Node):
    """A string without substitutions."""

    value: str


@dataclass(frozen=True, eq=False)
class Null(Node):
    """``null`` or ``None``."""


@dataclass(frozen=True, eq=False)
class Self(Node):
    """``this``, ``self`` or ``cls``."""


@dataclass(frozen=True, eq=False)
class Name(Node):
    """A bare name: a variable, a class, a module or, as the target of a call, a method."""

    name: str


@dataclass(frozen=True, eq=False)
class Opaque(Node):
    """Code that is not interpreted. Its parts are looked through."""

    inside: tuple[Node, ...] = ()


@dataclass(frozen=True, eq=False)
class Branch(Opaque):
    """Code that may or may not run: if, switch, try, while."""


@dataclass(frozen=True, eq=False)
class Choice(Node):
    """``condition ? one : other``, or ``one if condition else other``."""

    condition: Node
    one: Node
    other: Node


@dataclass(frozen=True, eq=False)
class Items(Node):
    """An array, list or tuple written out."""

    items: tuple[Node, ...]


@dataclass(frozen=True, eq=False)
class Member(Node):
    """``owner.name``."""

    owner: Node
    name: str


@dataclass(frozen=True, eq=False)
class Reference(Member):
    """Java's ``owner::name``: a method, never a field."""


@dataclass(frozen=True, eq=False)
class Element(Node):
    """``owner[index]``."""

    owner: Node
    index: Node


@dataclass(frozen=True, eq=False)
class Call(Node):
    """A call of a function, a method or a constructor.

    Args:
        target: what is called.
        args: the positional arguments.
        named: the keyword arguments, name and value.
        spread: whether ``*args`` or ``**kwargs`` adds arguments that cannot be read.
    """

    target: Node
    args: tuple[Node, ...]
    named: tuple[tuple[str, Node], ...] = ()
    spread: bool = False

    @property
    def all_args(self) -> tuple[Node, ...]:
        """The positional arguments and the values of the keyword arguments."""
        return (*self.args, *(node for _, node in self.named))

    @property
    def owner(self) -> Node | None:
        """The object on which a method is called; None for a bare function."""
        return self.target.owner if isinstance(self.target, Member) else None


@dataclass(frozen=True, eq=False)
class Operation(Node):
    """``left sign right``, or ``sign right`` where there is no left."""

    sign: str
    left: Node | None
    right: Node


@dataclass(frozen=True, eq=False)
class Cast(Node):
    """``(type) value``."""

    type: str
    value: Node


@dataclass(frozen=True, eq=False)
class Assign(Node):
    """A variable or a field gets a value, or is only declared (value None).

    Args:
        target: a Name, or a Member of Self or of something else.
        value: what it gets.
        type: its declared type as written; empty if none.
        declares: whether this brings a Java variable into being.
    """

    target: Node
    value: Node | None
    type: str = ""
    declares: bool = False


@dataclass(frozen=True, eq=False)
class Return(Node):
    """The value a function hands back."""

    value: Node


@dataclass(frozen=True, eq=False)
class Loop(Node):
    """``for variables in collection: body``; several variables take an element apart."""

    variables: tuple[str, ...]
    collection: Node
    body: tuple[Node, ...]


@dataclass(frozen=True, eq=False)
class FunctionParameter(Node):
    """One parameter of a function; ``type`` as written, or empty; ``default`` or None."""

    name: str
    type: str
    default: Node | None = None


@dataclass(frozen=True, eq=False)
class Function(Node):
    """A lambda, a method or a function; ``body`` is one Return for a lambda that is an expression.

    Args:
        name: empty for a lambda.
        parameters: without ``self``.
        body: its statements.
        property: whether it is read like a field (Python's ``@property``).
        type: what it returns, as written; empty if not.
    """

    name: str
    parameters: tuple[FunctionParameter, ...]
    body: tuple[Node, ...]
    property: bool = False
    type: str = ""


@dataclass(frozen=True, eq=False)
class Class(Node):
    """A class; ``bases`` are the last names of what it extends and implements."""

    name: str
    bases: tuple[str, ...]
    body: tuple[Node, ...]


@dataclass(frozen=True)
class Import:
    """A name brought in from another file.

    Args:
        name: what it is called here; ``*`` brings in everything.
        path: the dotted name of what it stands for: ``frc.robot.Constants``.
        level: how many leading dots a relative import has.
    """

    name: str
    path: str
    level: int = 0


@dataclass(frozen=True, eq=False)
class Module:
    """One file, brought to this syntax.

    Args:
        path: where it is.
        language: ``java`` or ``python``.
        source: its text in UTF-8.
        body: what stands at the top of it; a Java file has classes there and nothing else.
        imports: the names it brings in.
        package: the Java package it says it is in.
        problems: syntax errors.
    """

    path: Path
    language: str
    source: bytes
    body: tuple[Node, ...]
    imports: tuple[Import, ...] = ()
    package: str = ""
    problems: tuple[ParseProblem, ...] = ()


def iter_nodes(*nodes: Node, but: tuple[type[Node], ...] = ()) -> Iterator[Node]:
    """All nodes in and under some, in the order of the text.

    Args:
        nodes: where to begin.
        but: kinds of node that are given, but not looked into.
    """
    waiting = list(reversed(nodes))
    while waiting:
        node = waiting.pop()
        yield node
        if not isinstance(node, but):
            waiting.extend(reversed(node.parts))
