"""The runtime of a Java program: its budget, calls, lambdas, and members by name."""

import enum
import functools
import keyword
import types
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from grader.robotcode.java import lang, streams, text, type_names, values
from grader.robotcode.java.steps import DEEPEST, STATE, EndlessError
from grader.robotcode.java.syntax import At
from grader.robotcode.java.values import NullPointerException, StackOverflowError
from grader.robotcode.library.base import (
    Fake,
    FakeType,
    NoSuchMember,
    Unknown,
    WrongArgument,
    checked,
)

PYTHON_OWN = frozenset({"builtins", "enum"})  # modules whose members no Java program sees
Call = Callable[[Any, Sequence[Any]], Any]
# What interfaces of java.util.function take, by how their names begin; what their methods give.
TAKEN = {"DoubleTo": "double", "Double": "double", "IntTo": "int", "Int": "int", "Long": "long"}


class Function:
    """A lambda or method reference, as a value.

    Args:
        run: takes the arguments.
        arity: how many; -1 if nobody can tell.
        gives: whether it gives a value; None if nobody can tell.
        interface: the learner's own interface that it stands for, once it is known.
    """

    __slots__ = ("arity", "at", "gives", "interface", "run")

    def __init__(
        self, run: Callable[..., Any], at: At, arity: int = -1, gives: bool | None = None
    ) -> None:
        self.run, self.at, self.arity, self.gives = run, at, arity, gives
        self.interface: type | None = None

    def __call__(self, *args: Any) -> Any:
        enter()
        if self.arity >= 0 and len(args) != self.arity:
            raise WrongArgument(f"the lambda takes {self.arity} values and gets {len(args)}")
        result = self.run(*args)
        STATE.depth -= 1
        return result


def enter() -> None:
    """Begin a call.

    Raises:
        StackOverflowError: too many are within each other.
        EndlessError: the program has had its steps.
    """
    STATE.tick()
    STATE.depth += 1
    if STATE.depth > DEEPEST:
        STATE.depth = 0
        raise StackOverflowError


def python_name(name: str) -> str:
    """The attribute that holds a Java member."""
    if name.startswith("_"):
        return f"java{name}"
    return f"{name}_" if keyword.iskeyword(name) else name


def find_attribute(cls: type, name: str) -> Any:
    """A member of a class or of its bases, never one of Python's own; None if there is none."""
    attribute = python_name(name)
    for base in getattr(cls, "__mro__", ()):
        if attribute in base.__dict__ and base.__module__ not in PYTHON_OWN:
            return base.__dict__[attribute]
    return None


def find_caller(cls: type, name: str, kinds: Sequence[str]) -> Call:
    """What calls a method on values of a class.

    Args:
        cls: the class of the value.
        name: the method's name in Java.
        kinds: the static types of the arguments, empty where they cannot be told.

    Raises:
        NoSuchMember: the class has no such method.
    """
    table = _list_static_methods(cls)
    if table is not None and (name in table or not issubclass(cls, enum.Enum)):
        if name not in table:
            raise make_no_member_error(cls, f"{name}()", table)
        method = (
            checked(table[name]) if isinstance(table[name], types.FunctionType) else table[name]
        )
        return lambda value, args: method(value, *args)
    if cls is type(None):
        return _refuse_null(name)
    if cls is Unknown:
        return lambda value, args: getattr(value, python_name(name))(*args)
    if cls is Function:
        return lambda value, args: _call_function(value, name, args)
    found = find_attribute(cls, name)
    overloads = getattr(found, "overloads", None)
    if overloads is not None:
        return lambda value, args: overloads.call(value, args, kinds)
    if found is not None:
        attribute = python_name(name)
        if isinstance(found, types.FunctionType):
            return lambda value, args: found(value, *args)
        return lambda value, args: getattr(value, attribute)(*args)
    if name in OBJECT_METHODS:
        return lambda value, args: OBJECT_METHODS[name](value, *args)
    if name == "andThen" and issubclass(cls, streams.Functional):
        interface = cls.__mro__[cls.__mro__.index(streams.Functional) - 1]
        return lambda value, args: _chain_functions(value, interface, *args)
    if issubclass(cls, Fake):
        return lambda value, args: _find_member(value, name)(*args)
    if cls in {list, tuple, set, dict}:  # what a fake gives back
        return lambda _value, _args: Unknown(f"{name}()")
    if any("__call__" in vars(base) for base in cls.__mro__) and name in streams.FUNCTIONAL:
        return lambda value, args: value(*args)
    raise make_no_member_error(cls, f"{name}()", dir(cls))


def make_no_member_error(cls: type, name: str, known: Iterable[str]) -> NoSuchMember:
    """The error of a member that a class does not have, with the one that was meant."""
    names = [one for one in known if not one.startswith(("_", "fake_", "java"))]
    near = type_names.did_you_mean(name.removesuffix("()"), names)
    return NoSuchMember(f"{type_names.type_name(cls)} has no {name}{near}")


def _list_static_methods(cls: type) -> dict[str, Callable[..., Any]] | None:
    if issubclass(cls, bool | int | float):
        return lang.BOXED_METHODS
    if cls is str:
        return text.STRING_METHODS
    if issubclass(cls, values.Array):
        return ARRAY_METHODS
    return ENUM_METHODS if issubclass(cls, enum.Enum) else None


def _refuse_null(name: str) -> Call:
    def call(_value: Any, _args: Sequence[Any]) -> Any:
        raise NullPointerException(f'Cannot invoke "{name}()" because the value is null')

    return call


def _call_function(function: Function, name: str, args: Sequence[Any]) -> Any:
    """A method of a lambda: a default method of its interface, or the lambda itself."""
    interface = function.interface
    found = find_attribute(interface, name) if interface is not None else None
    overloads = getattr(found, "overloads", None)
    if overloads is not None and not overloads.abstract:
        return overloads.call(function, args, ())
    if overloads is not None:
        method, _ = overloads.choose(args, ())
        if method is not None:
            result = function(*method.bind(args, spread=False))
            return method.owner.convert("" if method.returns == "void" else method.returns, result)
        return function(*args)
    if name == "andThen":
        return _chain_functions(function, interface, *args)
    if name in streams.DEFAULT_METHODS:
        return Unknown(f"{name}() of a lambda")
    named = getattr(interface, "__name__", "Double" if name == "applyAsDouble" else "")
    kind = next((kind for start, kind in TAKEN.items() if named.startswith(start)), "")
    result = function(*(values.convert(kind, one) if kind else one for one in args))
    given = next((kind for end, kind in streams.GIVEN.items() if name.endswith(end)), "")
    return values.convert(given, result) if given and result is not None else result


def _chain_functions(first: Callable[..., Any], interface: Any, after: Any) -> Function:
    """Two consumers, which get the same; or two functions, of which one gets the other's result."""

    def call(*args: Any) -> Any:
        result = first(*args)
        consumes = getattr(interface, "__name__", "").endswith("Consumer")
        return after(*args) if consumes else after(result)

    made = Function(call, STATE.at)
    made.interface = interface
    return made


def get_field(value: Any, name: str) -> Any:
    """A field of a value, by its name.

    Raises:
        NoSuchMember: there is none.
    """
    if value is None:
        raise NullPointerException(f'Cannot read field "{name}" because the value is null')
    if isinstance(value, values.Array) and name == "length":
        return len(value)
    own = getattr(value, "__dict__", {})
    if f".{name}" in own:
        return own[f".{name}"]
    return _raise_no_method(_find_member(value, name), name)


def is_about_arguments(problem: Exception) -> bool:
    """Whether a TypeError says that a function was called with wrong arguments."""
    trace = problem.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    return trace is not None and trace.tb_frame.f_globals["__package__"] == __package__


def _find_member(value: Any, name: str) -> Any:
    """A member of an object, but none that only Python's own classes give it."""
    attribute, own = python_name(name), getattr(value, "__dict__", {})
    there = attribute in own or find_attribute(type(value), name) is not None
    number = isinstance(value, enum.Enum) and name == "value"  # of a controller's button
    if isinstance(value, Unknown) or number or (there and not name.startswith("_")):
        return getattr(value, attribute)
    if isinstance(value, Fake):
        return type(value).__getattr__(value, attribute)
    raise NoSuchMember(f"{type_names.type_name(type(value))} has no {name}")


def set_field(value: Any, name: str, new: Any) -> None:
    """Set a field of a value, by its name.

    Raises:
        NoSuchMember: there is none.
    """
    if value is None:
        raise NullPointerException(f'Cannot assign field "{name}" because the value is null')
    own = getattr(value, "__dict__", {})
    if f".{name}" in own:
        own[f".{name}"] = new
    elif isinstance(value, Unknown):
        return
    elif isinstance(value, Fake) and not name.startswith("_"):
        get_field(value, name)
        setattr(value, python_name(name), new)
    else:
        raise NoSuchMember(f"{type_names.type_name(type(value))} has no {name} that can be set")


def get_static(cls: Any, name: str) -> Any:
    """A static member of a library's class that is no method.

    Raises:
        NoSuchMember: there is none.
    """
    if isinstance(cls, Unknown):
        return getattr(cls, python_name(name))
    if isinstance(cls, enum.EnumType) and find_attribute(cls, name) is None:
        if name in cls.__members__:
            return cls[name]
        near = type_names.did_you_mean(name, list(cls.__members__))
        raise NoSuchMember(f"{cls.__name__} has no {name}{near}")
    return _raise_no_method(_find_static_member(cls, name), name)


def _find_static_member(cls: Any, name: str) -> Any:
    """A static member of a library's class, without those that all Python classes have."""
    attribute = python_name(name)
    if not name.startswith("_"):
        if find_attribute(cls, name) is not None:
            return getattr(cls, attribute)
        if isinstance(cls, FakeType):
            return FakeType.__getattr__(cls, attribute)
    raise make_no_member_error(cls, f"{name}()", dir(cls))


def _raise_no_method(found: Any, name: str) -> Any:
    if isinstance(found, types.FunctionType | types.MethodType | types.BuiltinFunctionType):
        raise NoSuchMember(f"{name} is a method: write {name}()")
    return found


def call_static(cls: Any, name: str, args: Sequence[Any]) -> Any:
    """Call a static method of a library's class.

    Raises:
        NoSuchMember: there is none.
    """
    if isinstance(cls, Unknown):
        return getattr(cls, python_name(name))(*args)
    if issubclass(cls, enum.Enum) and name in {"values", "valueOf"}:
        return enum_static(list(cls), cls.__name__, name, args)
    found = find_attribute(cls, name)
    if isinstance(found, types.FunctionType | functools.partialmethod) and not issubclass(
        cls, enum.Enum
    ):
        raise NoSuchMember(
            f"{name}() belongs to an object: {cls.__name__} is the class, which has none of its own"
        )
    return _find_static_member(cls, name)(*args)


def enum_static(every: Sequence[Any], kind: str, name: str, args: Sequence[Any]) -> Any:
    """``values()`` and ``valueOf(name)`` of an enum with some constants."""
    if name == "values":
        return values.Array(every, kind)
    found = next((one for one in every if type_names.enum_name(one) == args[0]), None)
    if found is None:
        raise values.IllegalArgumentException(f"No enum constant {kind}.{args[0]}")
    return found


OBJECT_METHODS: dict[str, Callable[..., Any]] = {
    "toString": values.to_string,
    "equals": values.equals,
    "hashCode": values.make_unknown("hashCode()"),
    "getClass": values.make_unknown("getClass()"),
}
ARRAY_METHODS: dict[str, Callable[..., Any]] = {
    **OBJECT_METHODS,
    "equals": lambda one, other: one is other,
    "clone": lambda one: values.Array(one, one.kind),
}
ENUM_METHODS: dict[str, Callable[..., Any]] = {
    "name": lambda one: one.name,
    "toString": lambda one: one.name,
    "ordinal": lambda one: list(type(one)).index(one),
    "compareTo": lambda one, other: list(type(one)).index(one) - list(type(one)).index(other),
    "equals": lambda one, other: one is other,
    "hashCode": lambda one: list(type(one)).index(one),
    "getClass": values.make_unknown("getClass()"),
    "getDeclaringClass": values.make_unknown("getDeclaringClass()"),
}

__all__ = ["STATE", "EndlessError"]
