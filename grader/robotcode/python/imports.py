"""The import of a learner's program: its own files, and fakes in place of libraries.

In a learner's files every private name, ``_speed``, gets another first sign. So its fields never
meet those of a fake that it derives from, and it reaches nothing private of a fake.
"""

import ast
import difflib
import sys
from collections.abc import Callable, Iterable, Sequence
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from importlib.util import spec_from_file_location, spec_from_loader
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any

from grader.robotcode.library.base import PYTHON, Fake, Unknown
from grader.robotcode.library.phoenix6 import TABLES, to_snake
from grader.robotcode.library.world import WORLD

MARK = "ǀ"  # in the place of a private name's underscore
NOT_PRIVATE = frozenset({"_replace", "_asdict", "_make", "_fields"})  # of Python's named tuples
NAMES = ("id", "attr", "name", "arg", "rest", "names", "kwd_attrs")  # where a node has its names
LIBRARIES = frozenset({name.partition(".")[0] for name in PYTHON} | {"hal", "wpinet", "cscore"})
NEARLY = 0.9  # how much of two names has to agree for one to be a slip of the other, from 0 to 1
SAME = frozenset(TABLES["python"]["same"].split())  # names that Phoenix 6 spells as in Java
PROPERTIES = frozenset(TABLES["python"]["properties"].split())


def rename(name: str) -> str:
    """The name under which a private name runs: no outside code can use it."""
    private = name.startswith("_") and not name.startswith("__") and not name.endswith("_")
    return MARK + name[1:] if private and name not in NOT_PRIVATE else name


def restore(text: str) -> str:
    """A text with names as the learner wrote them."""
    return text.replace(MARK, "_")


def compile_own(data: bytes | str, path: str, own: Iterable[str]) -> CodeType:
    """Compile a learner's file, with its private names renamed.

    Args:
        data: the text.
        path: of the file.
        own: names of the program's modules, from which private names are imported.
    """
    tree = ast.parse(data, path)
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            _rename_imports(node, set(own))
        elif not isinstance(node, ast.alias):
            _rename_node(node)
    return compile(tree, path, "exec")


def _rename_node(node: ast.AST) -> None:
    for field in NAMES:
        name = getattr(node, field, None)
        if isinstance(name, str):
            setattr(node, field, rename(name))
        elif isinstance(name, list):
            setattr(node, field, [rename(one) for one in name])
    if isinstance(node, ast.Call) and getattr(node.func, "id", "") in {"getattr", "hasattr"}:
        for one in node.args[1:2]:
            if isinstance(one, ast.Constant) and isinstance(one.value, str):
                one.value = rename(one.value)


def _rename_imports(node: ast.Import | ast.ImportFrom, own: set[str]) -> None:
    top = (getattr(node, "module", None) or "").partition(".")[0]
    local = isinstance(node, ast.ImportFrom) and (node.level > 0 or top in own)
    for one in node.names:
        bound = rename(one.asname or one.name)
        one.name = rename(one.name) if local else one.name
        one.asname = bound if bound != one.name and "." not in bound else None


class OwnLoader(SourceFileLoader):
    """Loads a file of the learner's."""

    own: tuple[str, ...] = ()

    def source_to_code(self, data: Any, path: Any, **_options: Any) -> CodeType:  # type: ignore[override]
        """Compile a learner's file, with its private names changed."""
        return compile_own(data, str(path), self.own)


class OwnFinder:
    """Finds the files of a program.

    Args:
        root: the folder that holds all of it.
        folders: where its imports begin.
    """

    def __init__(self, root: Path, folders: Sequence[Path]) -> None:
        self.root, self.folders = str(root), [str(one) for one in folders]
        OwnLoader.own = tuple(one.stem for one in root.rglob("*"))

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, _target: object = None
    ) -> ModuleSpec | None:
        """Where a module is, for Python's own import."""
        if name in sys.builtin_module_names:
            return None
        spec = PathFinder.find_spec(name, self.folders if path is None else path)
        places = list(spec.submodule_search_locations or ()) if spec else []
        if spec is None or not (spec.origin or places[0]).startswith(self.root):
            return None
        if spec.origin is None:
            return spec
        return spec_from_file_location(
            name,
            spec.origin,
            loader=OwnLoader(name, spec.origin),
            submodule_search_locations=spec.submodule_search_locations,
        )


class FakeModule(ModuleType):
    """A module of a library, made of fakes. What none stands for is unknown."""

    __path__: Any = ()

    def __getattr__(self, name: str) -> Any:  # whatever the module has
        if name.startswith("__"):
            raise AttributeError(name)
        whole = f"{self.__name__}.{name}"
        known = PYTHON.get(self.__name__, {})
        if whole in PYTHON:
            return __import__(whole, fromlist=["*"])
        near = difflib.get_close_matches(name, known, 1, NEARLY)
        if near:
            raise ImportError(f"{self.__name__} has no {name}. Did you mean {near[0]}?")
        WORLD.unknown.setdefault(whole, WORLD.where())
        return Unknown(name)


class FakeFinder:
    """Python's import looks here for the fakes of robot libraries.

    Args:
        every: whether there is an empty fake for any other module, too: it may be a file that was
            not handed in.
    """

    def __init__(self, *, every: bool) -> None:
        self.every = every

    def find_spec(self, name: str, _path: object = None, _target: object = None) -> Any:
        """A module of fakes, for Python's own import."""
        top, within = name.partition(".")[0], sys.modules.get(name.rpartition(".")[0])
        if (top not in LIBRARIES and not self.every) or top in sys.stdlib_module_names:
            return None
        if not isinstance(within, FakeModule | None):
            return None  # a package that is really there has no such part
        near = [] if top in LIBRARIES else difflib.get_close_matches(top, LIBRARIES, 1, NEARLY)
        if near:
            raise ModuleNotFoundError(f"No module named {top!r}. Did you mean {near[0]}?", name=top)
        if top not in LIBRARIES:
            WORLD.unknown.setdefault(name, WORLD.where())
        return spec_from_loader(name, self, is_package=True)  # type: ignore[arg-type]

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """An empty module."""
        if spec.name == "phoenix6":
            spell_phoenix6()
        return FakeModule(spec.name)

    def exec_module(self, module: ModuleType) -> None:
        """Fill it with its fakes."""
        vars(module).update(PYTHON.get(module.__name__, {}))


def spell_phoenix6() -> None:
    """Give the members of the fakes of Phoenix 6 the names that they have in Python."""
    waiting: list[Any] = [Fake]
    while waiting:
        cls = waiting.pop()
        waiting += [one for one in type.__subclasses__(cls) if one not in waiting]
        if not cls.__module__.endswith(".phoenix6"):
            continue
        for name, value in list(vars(cls).items()):
            spelled, make = _spell_for_python(name)
            if spelled != name and (callable(value) or isinstance(value, staticmethod)):
                type.__delattr__(cls, name)
                type.__setattr__(cls, spelled, make(value))
        cls.fake_others = frozenset(_spell_for_python(one)[0] for one in cls.fake_others)


def _spell_for_python(name: str) -> tuple[str, Callable[[Any], Any]]:
    """RobotPy's name of a Java member, and the function that turns Java's member into it."""
    if name in SAME or name.startswith("_"):
        return name, lambda one: one
    if name.removeprefix("get") in PROPERTIES:
        return to_snake(name.removeprefix("get")), property
    return to_snake(name), lambda one: one
