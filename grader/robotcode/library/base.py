"""The base of every fake: its packages, its members, and the unknown value.

A fake is a Python class that stands for a class of WPILib or of a vendor. Its public members have
the names that Java gives them (a Java name that is a keyword of Python ends in ``_``: ``and_``);
its own state has names that begin with ``_``. Both languages run on the same fakes.
"""

import difflib
import functools
import inspect
import sys
import tomllib
import types
import typing
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from grader.robotcode.library.world import WORLD

TABLES = tomllib.loads(Path(__file__).with_name("wpilib.toml").read_text("utf-8"))
JAVA: dict[str, type] = {}  # full name of a Java class -> its fake
PYTHON: dict[str, dict[str, Any]] = {}  # module of RobotPy or a vendor -> name -> its fake
JAVA_OWN = "grader.robotcode.java."  # modules of Java's library, which have not all overloads
NEARLY = 0.75  # how much of two names has to agree for a "did you mean", from 0 to 1


class NoSuchMember(AttributeError):
    """A member that a class does not have, in a learner's code."""


class WrongArgument(TypeError):
    """An argument that a method does not take."""


class Unknown:
    """A value that the grader does not know. Results computed from it are unknown, too.

    Args:
        text: what it comes from, as the code has it.
    """

    def __init__(self, text: str) -> None:
        self.unknown_text = text

    def __getattr__(self, name: str) -> "Unknown":
        if name.startswith("__"):
            raise AttributeError(name)
        return Unknown(f"{self.unknown_text}.{name}")

    def __call__(self, *_args: object, **_named: object) -> "Unknown":
        return Unknown(f"{self.unknown_text}()")

    def __str__(self) -> str:
        return self.unknown_text

    def __bool__(self) -> bool:
        return WORLD.decide(self.unknown_text)

    def __iter__(self) -> Iterator["Unknown"]:
        return iter([self] if WORLD.decide(self.unknown_text) else [])

    def _return_self(self, *_others: object) -> "Unknown":
        return self

    __hash__ = object.__hash__
    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = _return_self
    __rtruediv__ = __mod__ = __rmod__ = __floordiv__ = __rfloordiv__ = __pow__ = __rpow__ = (
        _return_self
    )
    __neg__ = __pos__ = __abs__ = __invert__ = __getitem__ = __round__ = __enter__ = _return_self
    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = _return_self  # type: ignore[assignment]
    __and__ = __rand__ = __or__ = __ror__ = __xor__ = __rxor__ = _return_self

    def __exit__(self, *_error: object) -> None:
        pass

    def __setitem__(self, _key: object, _value: object) -> None:
        pass


class FakeType(type):
    """The class of all fakes: knows the members that have no code of their own."""

    fake_complete: bool
    fake_others: frozenset[str]

    def __getattr__(cls, name: str) -> Any:  # whatever the member is
        return _find_unwritten(cls, name)


class Fake(metaclass=FakeType):
    """Base of every fake. A Java class of a learner may derive from it as well."""

    fake_complete = False
    fake_others: frozenset[str] = frozenset()
    java: Any = None  # the Java class of a learner that it was made from

    def __init__(self, *_args: Any, **_named: Any) -> None:
        """Accept any arguments, and ignore them."""

    def __getattr__(self, name: str) -> Any:  # whatever the member is
        return _find_unwritten(type(self), name)


def _find_unwritten(cls: FakeType, name: str) -> Any:  # whatever the member is
    """A member without code: a known one with an unknown result, or the learner's mistake."""
    if name.startswith("_"):
        raise AttributeError(name)
    if name in cls.fake_others or not cls.fake_complete:
        return Unknown(f"{cls.__name__}.{name}")
    known = [one for one in dir(cls) if not one.startswith(("_", "fake_"))]
    near = difflib.get_close_matches(name, [*known, *cls.fake_others], 1, NEARLY)
    hint = f". Did you mean {near[0].rstrip('_')}?" if near else ""
    raise NoSuchMember(f"{cls.__name__} has no {name}{hint}")


def fake(
    java: str = "", python: str = "", *, complete: bool = False, others: str = "", name: str = ""
) -> Callable[[type], type]:
    """Make a class available to learners' programs, with its arguments checked.

    Args:
        java: packages that Java knows it in, with spaces between; empty if Java has none.
        python: modules that RobotPy knows it in, with spaces between.
        complete: whether every public member is here or in ``others``: only then is another name
            a mistake of the learner's.
        others: names of members that do nothing here and whose result is unknown, besides those
            that ``wpilib.toml`` lists for it.
        name: its name in those packages, where that is not the class's.
    """

    def decorate(cls: type) -> type:
        _check_methods(cls)
        if isinstance(cls, FakeType):
            cls.fake_complete = complete or vars(cls).get("fake_complete", False)
            listed = f"{others} {TABLES['others'].get(cls.__name__, '')}"
            cls.fake_others = cls.fake_others | frozenset(listed.split())
        for package in java.split():
            JAVA[f"{package}.{name or cls.__name__}"] = cls
        for module in python.split():
            PYTHON.setdefault(module, {})[name or cls.__name__] = cls
        return cls

    return decorate


def add_named_classes(rows: Iterable[dict[str, Any]], base: type = Fake) -> None:
    """Make the classes of a ``names.toml``, which derive from a class unless they say another."""
    for row in rows:
        above = JAVA[row["base"]] if "base" in row else base
        for name in row["names"].split():
            made = FakeType(name, (above,), {"__doc__": above.__doc__})
            fake(row["java"], row.get("python", ""), complete=row.get("complete", False))(made)


def _check_methods(cls: type, within: tuple[type, ...] = ()) -> None:
    for name, one in list(vars(cls).items()):
        if isinstance(one, type) and not isinstance(one, types.GenericAlias):
            if isinstance(one, FakeType) and one not in (*within, cls):
                _check_methods(one, (*within, cls))
        elif isinstance(one, staticmethod | classmethod):
            setattr(cls, name, type(one)(checked(_name_method(one.__func__, cls, name))))
        elif inspect.isfunction(one) and (not name.startswith("_") or name == "__init__"):
            setattr(cls, name, checked(_name_method(one, cls, name)))


def _name_method(method: Any, cls: type, name: str) -> Any:
    """A method under its name in a class, which messages say, where it was made without one."""
    if "<" in method.__qualname__:
        method.__qualname__ = f"{cls.__name__}.{name}"
    return method


def checked(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function that refuses arguments of another kind than its annotations say.

    ``float`` takes whole numbers as well, ``int`` no fractions, ``Callable`` whatever can be
    called; None stands for Java's null wherever an object may stand. What is unknown passes. A
    function that fails on something unknown gives an unknown result, and so does a method of
    Java's own library with a number of arguments that it does not have here.
    """
    if hasattr(function, "checks"):
        return function
    signature = inspect.signature(function)
    named = function.__qualname__.removesuffix(".__init__")
    keys = list(signature.parameters)
    least = sum(
        one.default is one.empty and one.kind is one.POSITIONAL_OR_KEYWORD
        for one in signature.parameters.values()
    )
    free = any(one.kind is one.VAR_POSITIONAL for one in signature.parameters.values())
    most = sys.maxsize if free else len(keys)
    tests: list[tuple[int, Callable[[Any], bool]]] | None = None

    @functools.wraps(function)
    def run(*args: Any, **keywords: Any) -> Any:  # any method
        nonlocal tests
        if tests is None:
            tests = _make_tests(function, keys)
        count = len(args)
        if not keywords and not least <= count <= most:
            if function.__module__.startswith(JAVA_OWN):
                return Unknown(named)
            took = ", ".join(key for key in keys if key != "self")
            raise WrongArgument(f"{named} takes ({took}), and gets another number of arguments")
        for at, test in tests:
            if at < count and not test(args[at]) and type(args[at]) is not Unknown:
                raise WrongArgument(f"{named} takes another {keys[at]} than {describe(args[at])}")
        try:
            return function(*args, **keywords)
        except (TypeError, ValueError):
            if not any(type(one) is Unknown for one in args):
                raise
            return None if function.__name__ == "__init__" else Unknown(named)

    run.checks = True
    return run


def _make_tests(
    function: Callable[..., Any], keys: list[str]
) -> list[tuple[int, Callable[[Any], bool]]]:
    """The places of a function's annotated parameters, each with what its argument must pass."""
    hints = typing.get_type_hints(function)
    every = [(at, _make_test(hints[key])) for at, key in enumerate(keys) if key in hints]
    return [(at, test) for at, test in every if test is not None]


def accepts(kind: Any, value: Any) -> bool:  # any annotation and any value
    """Whether a parameter of a type takes a value."""
    test = _make_test(kind)
    return test is None or test(value)


def _make_test(kind: Any) -> Callable[[Any], bool] | None:  # any annotation
    """The test that values of a type pass; None if every value does."""
    if type(kind) is types.UnionType or typing.get_origin(kind) is typing.Union:
        tests = [_make_test(one) for one in typing.get_args(kind)]
        if None in tests:
            return None
        return lambda value: any(test(value) for test in tests if test is not None)
    if kind is float or kind is int:
        allowed = (int, float) if kind is float else int
        return lambda value: isinstance(value, allowed) and not isinstance(value, bool)
    if kind is bool:
        return lambda value: isinstance(value, bool)
    if kind is Any or kind is None or isinstance(kind, typing.TypeVar):
        return None
    origin = typing.get_origin(kind) or kind
    if origin is typing.Callable or origin is Callable:
        return lambda value: value is None or callable(value)
    if not isinstance(origin, type):
        return None
    return lambda value: value is None or isinstance(value, origin)


def describe(value: object) -> str:
    """A value in a message to a learner."""
    if value is None:
        return "null" if WORLD.language == "java" else "None"
    if isinstance(value, str):
        return f'the text "{value[:40]}"'
    return str(value) if isinstance(value, bool | int | float) else f"a {type(value).__name__}"
