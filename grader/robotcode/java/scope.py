"""What names stand for: local variables of a method, classes of a program and of its libraries."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from tree_sitter import Node

from grader.robotcode.java.syntax import At

if TYPE_CHECKING:
    from grader.robotcode.java.classes import JavaClass

Env = list[Any]  # the local variables of one call: [0] is this, [1] what it returns
Run = Callable[[Env], Any]
Place = Callable[[Env], tuple[Any, Any]]  # gives what holds a value, and its key there
THIS, RESULT = 0, 1


@dataclass(slots=True)
class Code:
    """A compiled expression.

    Args:
        run: what computes it.
        kind: its type by name, erased; empty if it cannot be told.
        place: what finds where it is stored; None of what cannot be assigned.
        fixed: why it cannot be assigned all the same; empty if it can.
    """

    run: Run
    kind: str = ""
    place: Any = None
    fixed: str = ""


@dataclass
class Arguments:
    """The compiled arguments of a call.

    Args:
        run: what computes them.
        codes: each of them.
    """

    run: Callable[[Env], list[Any]]
    codes: Sequence[Code]

    @property
    def kinds(self) -> tuple[str, ...]:
        """The types of the variables."""
        return tuple(one.kind for one in self.codes)


@dataclass
class Local:
    """A local variable or parameter.

    Args:
        slot: its place in an Env.
        kind: its type.
        final: whether it may not be assigned: it has a value from the start.
        depth: how many lambdas it is declared in.
    """

    name: str
    slot: int
    kind: str
    final: bool = False
    depth: int = 0


class Frame:
    """The local variables of one method or initializer, with those of the lambdas in it.

    Args:
        owner: the class it belongs to.
        static: whether there is no ``this``.
        outer: the frame around the class, if the class is local or not static.
    """

    def __init__(self, owner: "JavaClass", *, static: bool, outer: "Frame | None" = None) -> None:
        self.owner, self.static, self.outer = owner, static, outer
        self.scopes: list[dict[str, Local]] = [{}]
        self.classes: list[dict[str, JavaClass]] = [{}]
        self.size, self.depth = 2, 0
        self.every: list[Local] = []
        self.variables: set[str] = set()  # the method's type parameters
        self.field_rank = -1  # of the field whose initializer this is; it sees only those before

    def make_env(self, this: Any, *values: Any) -> Env:
        """The variables of a call; the first ones, its parameters, have values."""
        return [this, None, *values, *[None] * (self.size - 2 - len(values))]

    def declare(self, name: str, kind: str, *, final: bool = False) -> Local:
        """Make a variable in the innermost block."""
        local = Local(name, self.size, kind, final, self.depth)
        self.size += 1
        self.scopes[-1][name] = local
        self.every.append(local)
        return local

    def find(self, name: str) -> Local | None:
        """A variable by its name, the innermost first."""
        return next((one[name] for one in reversed(self.scopes) if name in one), None)

    def find_class(self, name: str) -> "JavaClass | None":
        """A local class by its name."""
        return next((one[name] for one in reversed(self.classes) if name in one), None)

    def push(self) -> None:
        """Begin a block."""
        self.scopes.append({})
        self.classes.append({})

    def pop(self) -> None:
        """End a block."""
        self.scopes.pop()
        self.classes.pop()


@dataclass
class Field:
    """A field of a class.

    Args:
        name, kind: as declared.
        key: where an instance or its class keeps it.
        rank: its place in the order of the text.
        value: the node of its initializer.
    """

    name: str
    kind: str
    static: bool
    final: bool
    key: str
    rank: int
    at: At
    value: Node | None = None


def text(node: Node | None) -> str:
    """The source of a node."""
    return (node.text or b"").decode() if node is not None else ""


def named(node: Node) -> Iterator[Node]:
    """The children that are no signs and no comments."""
    return (one for one in node.named_children if not one.type.endswith("comment"))


def child(node: Node, *kinds: str) -> Node | None:
    """The first child of some kinds."""
    return next((one for one in node.children if one.type in kinds), None)


def kind_of(node: Node | None, extra: str = "") -> str:
    """The erased name of a type: ``List`` for ``List<String>``, ``int[]`` for ``int[]``."""
    if node is None:
        return ""
    if node.type == "array_type":
        sizes = text(node.child_by_field_name("dimensions")).count("[")
        return kind_of(node.child_by_field_name("element")) + "[]" * sizes + extra
    if node.type in {"generic_type", "annotated_type"}:
        inner = [
            one
            for one in named(node)
            if one.type not in {"type_arguments", "marker_annotation", "annotation"}
        ]
        return kind_of(inner[0]) + extra if inner else extra
    if node.type == "scoped_type_identifier":
        return ".".join(kind_of(one) for one in named(node) if "annotation" not in one.type) + extra
    return "".join(text(node).split()) + extra
