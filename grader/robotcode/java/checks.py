"""What javac knows before a program runs: types of expressions, and what does not fit them.

Only what cannot be right is refused. A type that cannot be told is empty, and fits everywhere.
"""

import functools
import inspect
import types
import typing
from collections.abc import Callable, Sequence
from typing import Any

from tree_sitter import Node

from grader.robotcode.java import runtime, streams, type_names, values
from grader.robotcode.java.classes import (
    BOXES,
    NUMBERS,
    PRIMITIVES,
    JavaClass,
    Method,
    python_class,
)
from grader.robotcode.java.program import java_name
from grader.robotcode.java.scope import MISSING, Code, Frame, kind_of
from grader.robotcode.java.syntax import At
from grader.robotcode.java.text import STRING_METHODS
from grader.robotcode.library.base import Fake, Unknown

SMALL = frozenset({"byte", "short", "char"})  # a constant of int fits into them if it is small
WIDENS = {one: frozenset(NUMBERS[at + 1 :]) for at, one in enumerate(NUMBERS)}
WIDENS["char"] = frozenset(NUMBERS[2:])
# What every value may be called, and a value of which may be anything else once it is cast.
VAGUE = frozenset({"Object", "Number", "Comparable", "Serializable", "CharSequence", "Cloneable"})
STRING_RESULTS = {
    name: kind
    for kind, names in {
        "int": "length indexOf lastIndexOf compareTo",
        "char": "charAt",
        "boolean": "equals equalsIgnoreCase isEmpty isBlank contains startsWith endsWith matches",
        "String": "substring trim strip toUpperCase toLowerCase replace replaceAll concat repeat",
    }.items()
    for name in names.split()
}
FAKES = "grader.robotcode.library."  # modules whose functions say with annotations what they take
ANNOTATED = {float: "double", int: "int", bool: "boolean", str: "String"}
TAKES = {  # by the annotation of a parameter: the primitive types that it takes
    float: {*NUMBERS, "char"},
    int: {"byte", "short", "int", "long", "char"},
    bool: {"boolean"},
    str: set(),
}


class TypeChecker:
    """Finds the types of one method, and writes down what javac would refuse.

    Args:
        owner: the class that the method belongs to.
        frame: its local variables.
    """

    def __init__(self, owner: JavaClass, frame: Frame) -> None:
        self.owner, self.frame = owner, frame
        self.program = owner.unit.program

    def at(self, node: Node) -> At:
        """Where a node stands."""
        return self.owner.unit.source.at(node)

    # -- types ------------------------------------------------------------------------------

    def resolve(self, name: str) -> Any:
        """The class of a name, or None."""
        return self.program.resolve(name, self.owner, self.frame)

    def class_of_kind(self, kind: str) -> Any:
        """The class of the values of a type, a JavaClass or a library's; None if none is known."""
        found = self.resolve(kind) if kind and not kind.endswith("[]") else None
        return found if isinstance(found, JavaClass | type) else None

    def find_type(self, node: Node | None) -> Any:
        """The class that a type stands for; an unknown one is written down."""
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

    def seen_from_here(self, owner: JavaClass, kind: str) -> str:
        """A type as the text of another class has it, under a name that means the same here."""
        kind = erased_in(owner, kind)
        name = kind.rstrip("[]")
        if owner is self.owner or not name or name in PRIMITIVES or name in {"String", "void"}:
            return kind
        found = self.program.resolve(name, owner)
        return self.name_here(found, name) + kind[len(name) :] if found is not None else ""

    def name_here(self, cls: Any, name: str) -> str:
        """What a class can be called here: its simple name, or else its full one."""
        if isinstance(cls, Unknown):
            return ""
        full = cls.full_name.replace("$", ".") if isinstance(cls, JavaClass) else java_name(cls)
        return next((one for one in (name, full) if one and self.resolve(one) is cls), "")

    def result_in(self, cls: Any, name: str) -> str:
        """The type of what a class's method gives back; empty if it cannot be told."""
        if cls is str:
            return STRING_RESULTS.get(name, "")
        if not isinstance(cls, JavaClass | type):
            return ""
        found = runtime.find_attribute(python_class(cls), name)
        if isinstance(cls, type) and cls.__name__ in BOXES and cls.__module__ == values.__name__:
            of_box = {"valueOf": cls.__name__, "parse": BOXES[cls.__name__]}
            return of_box.get("parse" if name.startswith("parse") else name, "")
        overloads = getattr(found, "overloads", None)
        if overloads is not None:
            results = {self.seen_from_here(one.owner, one.returns) for one in overloads.methods}
            return results.pop() if len(results) == 1 and overloads.inherited is None else ""
        hint = _hints(getattr(found, "__func__", found)).get("return")
        if hint in ANNOTATED:
            return ANNOTATED[hint]
        if not isinstance(hint, type) or not issubclass(hint, Fake) or hint is Fake:
            return ""
        result = cls if isinstance(cls, type) and issubclass(cls, hint) else hint  # gives itself
        return self.name_here(result, result.__name__)

    # -- values -----------------------------------------------------------------------------

    def why_not(self, kind: str, code: Code) -> str:
        """What javac says of a value where another type is wanted; empty if it may be."""
        given = code.kind
        if given == "void" and kind:
            return "a method that returns nothing gives no value"
        if not kind or not given or kind in {given, "Object"}:
            return ""
        clash = f"incompatible types: {_short(given)} cannot be converted to {_short(kind)}"
        source, target = BOXES.get(given, given), BOXES.get(kind, kind)
        if given in {"null", "lambda"}:
            wrong = kind in PRIMITIVES or (given == "lambda" and target in {*PRIMITIVES, "String"})
            return clash if wrong else ""
        if not (source in PRIMITIVES and target in PRIMITIVES):
            return "" if self._may_be(kind, given) else clash
        if source == target or _fits(target, given, code.constant):
            return ""
        if kind in BOXES or "boolean" in (source, target):
            return clash
        lossy = f"incompatible types: possible lossy conversion from {given} to {kind}"
        return "" if kind in WIDENS[source] else lossy

    def _may_be(self, kind: str, given: str) -> bool:
        """Whether a value of one type may be of another; also where nobody can tell."""
        if kind.endswith("[]") and given.endswith("[]"):
            inner = kind[:-2], given[:-2]
            return inner[0] == inner[1] or (PRIMITIVES.isdisjoint(inner) and self._may_be(*inner))
        if kind in VAGUE or given in VAGUE:
            return True
        if (
            "String" in (kind, given)
            or {kind, given} & {*PRIMITIVES, *BOXES}
            or "[]" in kind + given
        ):
            return any(self._is_open(one) for one in (kind, given))
        one, other = (self.class_of_kind(each) for each in (kind, given))
        if one is None or other is None or not (is_sure(one) and is_sure(other)):
            return True
        base, cls = python_class(one), python_class(other)
        if issubclass(cls, base) or (not isinstance(other, JavaClass) and issubclass(base, cls)):
            return True
        method = streams.FUNCTIONAL_INTERFACES.get(base.__name__, "")
        return bool(method) and (_has_call(cls) or runtime.find_attribute(cls, method) is not None)

    def _is_open(self, kind: str) -> bool:
        """Whether nobody knows what values a type has."""
        simple = kind.endswith("[]") or kind in PRIMITIVES or kind in BOXES or kind == "String"
        return not simple and self.class_of_kind(kind) is None

    # -- calls ------------------------------------------------------------------------------

    def unknown_method(self, cls: Any, name: str) -> str:
        """What to say where a class has no method of a name; empty if it may have one."""
        if cls is str:
            known = [*STRING_METHODS, *runtime.OBJECT_METHODS]
            return "" if name in known else unknown_name("method", name, known, "String")
        attribute = runtime.find_attribute(python_class(cls), name)
        if attribute is not None or name in runtime.OBJECT_METHODS or not is_sure(cls):
            return ""
        base = cls.library_base if isinstance(cls, JavaClass) else cls
        ours = base is not None and base.__module__.startswith(__name__.rpartition(".")[0])
        if ours or name in getattr(base, "fake_others", ()):
            return ""
        own = isinstance(cls, JavaClass)
        if own and ((cls.form == "enum" and name in ENUM) or name in streams.FUNCTIONAL):
            return ""
        return unknown_name("method", name, member_names(cls), cls.name if own else cls.__name__)

    def unknown_field(self, cls: Any, name: str) -> str:
        """What to say where a class has no field of a name."""
        label = cls.name if isinstance(cls, JavaClass) else cls.__name__
        return unknown_name("field", name, member_names(cls), label)

    def misfit(self, found: Any, codes: Sequence[Code], label: str = "") -> str:
        """What javac says of arguments that a method does not take; empty if it may."""
        overloads = getattr(found, "overloads", None)
        if overloads is not None:
            if overloads.inherited is not None:
                return ""
            return self.misfit_of(overloads.methods, codes)
        function = getattr(found, "__func__", found)
        if not isinstance(function, types.FunctionType) or not function.__module__.startswith(
            FAKES
        ):
            return ""
        hints, listed = _hints(function), _parameters(function)
        if not isinstance(found, staticmethod):
            listed = listed[1:]
        if any(one.kind is not one.POSITIONAL_OR_KEYWORD for one in listed):
            return ""
        least = sum(one.default is one.empty for one in listed)
        label = label or function.__qualname__
        if not least <= len(codes) <= len(listed):
            wanted = ", ".join(one.name for one in listed)
            return f"{label}({wanted}) does not take {_count(codes)}"
        for one, code in zip(listed, codes, strict=False):
            if not self._takes(hints.get(one.name), code):
                return f"incompatible types: {label} takes no {_short(code.kind)} for {one.name}"
        return ""

    def misfit_new(self, cls: Any, codes: Sequence[Code]) -> str:
        """What javac says of arguments that no constructor of a class takes; empty if one may."""
        if not isinstance(cls, JavaClass):
            return self.misfit(cls.__init__, codes, cls.__name__) if isinstance(cls, type) else ""
        _ = cls.cls  # which declares its constructors
        if cls.constructors:
            return self.misfit_of(cls.constructors, codes)
        return f"new {cls.name}() takes no arguments" if codes and cls.name else ""

    def misfit_of(self, methods: Sequence[Method], codes: Sequence[Code]) -> str:
        """What javac says of arguments that fit no method of that name."""
        said = ""
        for one in methods:
            kinds = [self.seen_from_here(one.owner, kind) for kind in one.kinds]
            if one.varargs:
                kinds = kinds[:-1]
            elif len(codes) != len(kinds):
                continue
            if len(codes) < len(kinds):
                continue
            wrong = map(self.why_not, kinds, codes)
            said = next((why for why in wrong if why), "")
            if not said:
                return ""
        wanted = " or ".join(f"({', '.join(one.kinds)})" for one in methods)
        if said and len(methods) == 1:
            return said
        given = ", ".join(one.kind or "?" for one in codes)
        given = f"({given})" if said else _count(codes)
        return f"{methods[0].name}{wanted} does not take {given}"

    def _takes(self, hint: Any, code: Code) -> bool:
        """Whether a parameter with an annotation takes a value, or nobody can tell."""
        kind = BOXES.get(code.kind, code.kind)
        if kind in {"", "null", "Object"} or hint in {None, object, Any}:
            return True
        if kind == "void":
            return False
        if typing.get_origin(hint) in {typing.Union, types.UnionType}:
            return any(self._takes(one, code) for one in typing.get_args(hint))
        plain = kind in PRIMITIVES or kind == "String"
        if hint in TAKES:
            return (
                kind in TAKES[hint]
                if kind in PRIMITIVES
                else (
                    kind in VAGUE
                    or ((kind == "String") == (hint is str) and not self._is_class(kind))
                )
            )
        origin = typing.get_origin(hint) or hint
        if origin is Callable:
            return kind == "lambda" or (not plain and self._may_be_called(kind))
        if not isinstance(origin, type) or kind == "lambda":
            return True
        if plain or kind.endswith("[]"):
            return not issubclass(origin, Fake)
        cls = python_class(self.class_of_kind(kind))
        sure = isinstance(cls, type) and issubclass(origin, Fake) and is_sure(self.resolve(kind))
        return not sure or issubclass(cls, origin) or issubclass(origin, cls)

    def _is_class(self, kind: str) -> bool:
        return kind != "String" and (kind == "lambda" or self.class_of_kind(kind) is not None)

    def _may_be_called(self, kind: str) -> bool:
        found = self.class_of_kind(kind)
        if kind.endswith("[]"):
            return False
        if isinstance(found, JavaClass):
            functional = any(one.form == "interface" or one.interfaces for one in found.ancestors())
            return functional or not is_sure(found) or _has_call(found.library_base)
        return found is None or found.__name__ in VAGUE or _has_call(found)


ENUM = frozenset({"values", "valueOf", "name", "ordinal", "compareTo", "getDeclaringClass"})


def _has_call(cls: Any) -> bool:
    return any("__call__" in vars(base) for base in getattr(cls, "__mro__", ()))


def _count(codes: Sequence[Code]) -> str:
    return (
        "no argument"
        if not codes
        else "1 argument"
        if len(codes) == 1
        else f"{len(codes)} arguments"
    )


def _short(kind: str) -> str:
    return kind.rpartition(".")[2]


@functools.lru_cache(maxsize=4096)
def _hints(function: Any) -> dict[str, Any]:
    if not isinstance(function, types.FunctionType) or not function.__annotations__:
        return {}
    return typing.get_type_hints(function)


@functools.lru_cache(maxsize=4096)
def _parameters(function: Any) -> list[inspect.Parameter]:
    return list(inspect.signature(function).parameters.values())


def is_sure(cls: Any) -> bool:
    """Whether all members of a class, and all classes above it, are known."""
    if isinstance(cls, JavaClass):
        above = [one for up in cls.ancestors() for one in (up.parent, *up.interfaces)]
        if any(up.lombok for up in cls.ancestors()):
            return False
        return all(isinstance(one, JavaClass) or one is None or is_sure(one) for one in above)
    return isinstance(cls, type) and issubclass(cls, Fake) and cls.fake_complete


def unknown_name(what: str, name: str, known: Sequence[str], label: str) -> str:
    """What to say of a name that nothing has, with the one that was meant."""
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


def _fits(kind: str, given: str, constant: Any) -> bool:
    """Whether a constant may be assigned to a narrower type, because its value fits."""
    if constant is MISSING or kind not in SMALL or given not in SMALL | {"int"}:
        return False
    number = ord(constant) if given == "char" else int(constant)
    narrow = values.cast(kind, number)
    return (ord(narrow) if kind == "char" else int(narrow)) == number


def promoted(sign: str, left: str, right: str) -> str:
    """The type of an operation on two types; empty if it cannot be told."""
    if sign == "+" and "String" in (left, right):
        return "String"
    if sign in {"<<", ">>", ">>>"}:
        return ("long" if left == "long" else "int") if left in PRIMITIVES else ""
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
    small = kinds - {"int"}
    whole = [one for one in codes if BOXES.get(one.kind, one.kind) == "int"]
    if len(small) == 1 and small <= SMALL and all(one.constant is not MISSING for one in whole):
        kind = small.pop()
    for one in codes:
        one.run = _cast_to(kind, one.run)
    return kind


def _cast_to(kind: str, run: Callable[[Any], Any]) -> Callable[[Any], Any]:
    return lambda env: values.cast(kind, run(env))
