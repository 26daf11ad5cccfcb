"""A Python program on the bench: its class is made as a robot's program would make it."""

import ast
import contextlib
import difflib
import functools
import importlib
import inspect
import itertools
import re
import signal
import sys
import traceback
import typing
from collections import OrderedDict
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from grader.robotcode.bench.button_run import Factory
from grader.robotcode.bench.facts import Outcome
from grader.robotcode.bench.simulation import walk_fields
from grader.robotcode.bench.subject import Subject, list_choices, list_made, make_library_object
from grader.robotcode.library.base import NEARLY, Fake, Unknown
from grader.robotcode.library.world import WORLD
from grader.robotcode.python.imports import (
    FakeFinder,
    OwnFinder,
    rename,
    restore,
)

SECONDS = 2.0  # [s] of the processor's time for one loop, or to start
MAKES = frozenset({"SysIdRoutine", "quasistatic", "dynamic"})  # in what makes a routine or a test
BINDS = re.compile(r"(while|on|toggleOn)(True|False)$")
MOST_SAID = 300  # signs of an error message
DEEP = 3  # constructors within constructors that are given what they ask for


class EndlessError(BaseException):
    """The program does not come back."""


class PythonSubject(Subject):
    """A Python program, and its class that is tested.

    Args:
        path: the file in hand.
        root: the folder that holds all of the program, and nothing else.
        wanted: a pattern of names that tell the class from others of the file.
    """

    language = "python"
    season = 2026

    def __init__(self, path: Path, root: Path, wanted: str = "SysIdRoutine$") -> None:
        self.path, self.root = path, root
        self.text = path.read_text("utf-8-sig")
        WORLD.where, WORLD.stack = self.find_line, self.list_calls
        self.trees = {one: ast.parse(one.read_bytes()) for one in _list_parsable(root)}
        self.tree = self.trees[path]
        self.classes = {
            node.name: node
            for tree in (*self.trees.values(), self.tree)
            for node in tree.body
            if isinstance(node, ast.ClassDef)
        }
        self.node = self._choose_class(wanted)
        self.name = self.node.name if self.node is not None else path.stem
        self.module = ModuleType("")
        if hasattr(signal, "setitimer"):
            signal.signal(signal.SIGVTALRM, _end_loop)

    # -- its text ---------------------------------------------------------------------------

    def _choose_class(self, wanted: str) -> ast.ClassDef | None:
        """The class of the file that has a name of the pattern, itself or in its bases."""
        mine = [node for node in self.tree.body if isinstance(node, ast.ClassDef)]
        aliases = {
            alias.asname
            for node in ast.walk(self.tree)
            if isinstance(node, ast.ImportFrom)
            for alias in node.names
            if alias.asname and re.search(wanted, alias.name)
        }
        makes = [
            one
            for one in mine
            for names in [{name for part in self._list_ancestors(one) for name in list_names(part)}]
            if names & aliases or any(re.search(wanted, name) for name in names)
        ]
        found = makes or mine
        bases = {part.name for one in found for part in self._list_ancestors(one)[1:]}
        named = [
            one for one in found if one.name.lower() == self.path.stem.replace("_", "").lower()
        ]
        return next(iter(named or [one for one in found if one.name not in bases]), None)

    def _list_ancestors(self, node: ast.ClassDef) -> list[ast.ClassDef]:
        """A class and those of its bases that the program defines."""
        found = [node]
        for one in found:
            names = {name for base in one.bases for name in list_names(base)}
            found += [
                self.classes[n] for n in names if n in self.classes and self.classes[n] not in found
            ]
        return found

    def _walk_frames(self) -> Iterator[tuple[str, int]]:
        """The files and lines of the program that are being run, the innermost first."""
        frame: Any = sys._getframe(1)  # as Python's own tools do
        while frame is not None:
            if frame.f_code.co_filename.startswith(str(self.root)):
                yield frame.f_code.co_filename, frame.f_lineno
            frame = frame.f_back

    def find_line(self) -> int:
        """The line of the learner's code that is being run."""
        return next((line for _, line in self._walk_frames()), 0)

    def list_calls(self) -> list[int]:
        """The lines that are being run, the innermost first; 0 in another file."""
        return [line if name == str(self.path) else 0 for name, line in self._walk_frames()]

    # -- its run ----------------------------------------------------------------------------

    def start(self) -> None:
        """Import the file, and make the class."""
        self.refill()
        self.module = importlib.import_module(self._install())
        self.instance = SimpleNamespace(**vars(self.module))  # a program without a class
        if self.node is not None:
            self.instance = self.make(getattr(self.module, rename(self.node.name)))
            getattr(self.instance, "robotInit", list)()

    def _install(self) -> str:
        """Let its imports find the program; the name of the file as a module."""
        levels = [
            node.level
            for tree in self.trees.values()
            for node in ast.walk(tree)
            if isinstance(node, ast.ImportFrom)
        ]
        within = max([*levels, (self.path.parent.parent / "robot.py").is_file()])
        parts = [*self.path.parts[:-1], self.path.stem][-1 - within :]
        above = [self.path.parent, self.path.parent.parent, self.root]
        sys.meta_path.insert(0, OwnFinder(self.root, above))
        sys.meta_path.append(FakeFinder(every=True))
        Unknown.__mro_entries__ = lambda _self, _bases: (Fake,)  # type: ignore[attr-defined]
        return ".".join(parts)

    @property
    def modules(self) -> list[ModuleType]:
        """The learner's modules that were imported."""
        files = {str(one) for one in self.trees}
        return [one for one in list(sys.modules.values()) if getattr(one, "__file__", "") in files]

    def make(self, cls: Any, depth: int = 0) -> Any:  # a class
        """An object of a class; its constructor gets the same kind of arguments as on a robot."""
        own = getattr(cls, "__module__", "") in {one.__name__ for one in self.modules}
        if not own:
            return make_library_object(cls)
        children = [one for one in cls.__subclasses__() if not inspect.isabstract(one)]
        if inspect.isabstract(cls) and children:
            return self.make(children[0], depth)
        hints: dict[str, Any] = {}
        with contextlib.suppress(Exception):  # an annotation that names nothing stops no program
            hints = typing.get_type_hints(cls.__init__)
        given = {}
        parameters: Any = {}
        with contextlib.suppress(ValueError):  # a class of RobotPy's that takes nothing
            parameters = inspect.signature(cls).parameters
        for name, one in parameters.items():
            if one.default is one.empty and one.kind not in {one.VAR_POSITIONAL, one.VAR_KEYWORD}:
                given[name] = self._make_argument(restore(name), hints.get(name), depth)
        return cls(**given)

    def _make_argument(self, name: str, kind: Any, depth: int) -> Any:  # any annotation
        if isinstance(kind, type) and kind not in {Any, float} and depth < DEEP:
            simple = {int: 1, bool: False, str: "name"}
            return simple[kind] if kind in simple else self.make(kind, depth + 1)
        return Unknown(name)

    def find_routines(self) -> list[Any]:
        """The routines that a call of a method makes."""
        return list_made("routines", self._ask_methods)

    def _ask_methods(self) -> None:
        for one in self._list_makers(self.node):
            self._call(self.instance, one)

    def _list_makers(self, owner: ast.ClassDef | None) -> list[ast.FunctionDef]:
        """The methods of a class and its bases that give tests or a routine."""
        return [
            one
            for part in (self._list_ancestors(owner)[::-1] if owner is not None else ())
            for one in part.body
            if isinstance(one, ast.FunctionDef) and one.name != "__init__"
            if any(isinstance(node, ast.Return) and node.value for node in ast.walk(one))
            if list_names(one) & MAKES or "Command" in ast.unparse(one.returns or one.args)
        ]

    def _call(self, instance: object, node: ast.FunctionDef) -> None:
        """Call a method with each value that its parameters can have, if those are known."""
        found = getattr(instance, rename(node.name), None)  # a property is asked by that
        if not callable(found):
            return
        signature = inspect.signature(found, eval_str=False)
        wanted = [
            one
            for one in signature.parameters.values()
            if one.default is one.empty and one.kind not in {one.VAR_POSITIONAL, one.VAR_KEYWORD}
        ]
        for values in itertools.product(*map(_choose_values, wanted)):
            named = OrderedDict(
                (one.name, value) for one, value in zip(wanted, values, strict=True)
            )
            bound = inspect.BoundArguments(signature, named)
            found(*bound.args, **bound.kwargs)

    def _try_call(self, instance: object, node: ast.FunctionDef) -> None:
        with contextlib.suppress(Exception):  # a method that wants something else
            self._call(instance, node)

    @staticmethod
    def refill() -> None:
        """Give the program the time of one more loop."""
        if hasattr(signal, "setitimer"):
            signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS)

    def explain(self, error: BaseException) -> tuple[Outcome, str, int, str]:
        """The error that ended the program, with its line."""
        steps = traceback.extract_tb(error.__traceback__)
        lines = [one.lineno or 0 for one in steps if one.filename.startswith(str(self.root))]
        line = lines[-1] if lines else 0
        if isinstance(error, EndlessError):
            return Outcome.ENDLESS, "the code here runs without end", line, "endless"
        if isinstance(error, SystemExit):
            return Outcome.CRASHED, "sys.exit() ends the program", line, "exit"
        if isinstance(error, SyntaxError):
            line = error.lineno or 0
        kind = next(one.__name__ for one in type(error).__mro__ if one.__module__ == "builtins")
        kind = type(error).__name__ if kind in {"Exception", "BaseException"} else kind
        first = f"{kind}: {error}".strip().splitlines()[0].rstrip(" :")
        said = restore("".join(sign if sign.isprintable() else " " for sign in first[:MOST_SAID]))
        if "name 'self' is not defined" in said:
            said += ": the body of a class has no self"
        elif kind in {"AttributeError", "NameError"} and "Did you mean" not in said:
            said += self._suggest_name(said)
        if isinstance(error, TypeError) and "Unknown" in str(error):
            return Outcome.CANNOT, f"the grader cannot know a value in line {line}", line, kind
        if isinstance(error, FileNotFoundError | PermissionError):
            said = (
                f"the grader cannot provide the value that the program needs in line {line}: {said}"
            )
            return Outcome.CANNOT, said, line, kind
        return Outcome.CRASHED, said, line, kind

    def _suggest_name(self, said: str) -> str:
        """The name of the program's own that is most like the one that is not there."""
        missing = re.findall(r"\w+", said.removesuffix(" is not defined"))[-1]
        names = list_names(self.tree) - {missing}
        near = difflib.get_close_matches(missing, names, 1, NEARLY)
        return f". Did you mean {near[0]}?" if near else ""

    def describe(self) -> dict[str, Any]:
        """The facts that the program's text tells without running it."""
        unknown = WORLD.undecided | WORLD.unknown
        return {
            "errors": (),
            "unknown": {restore(str(name)): int(line) for name, line in unknown.items()},
        }

    # -- buttons ----------------------------------------------------------------------------

    def list_factories(self) -> list[Factory]:
        """The methods that give commands, with the tests that they made when they were called."""
        found = []
        instances = {type(one).__name__: one for _, _, one in walk_fields(self.instance)}
        for node in self.classes.values():
            for one in self._list_makers(node) if rename(node.name) in instances else ():
                call = functools.partial(self._try_call, instances[rename(node.name)], one)
                tests = tuple(test for test, _, _ in list_made("tests", call))
                if tests:
                    public = not one.name.startswith("_")
                    found.append(Factory(node.name, one.name, public, one.lineno, tests))
        return found

    def autonomous(self) -> Any:  # a command of either backend
        """The command of autonomous; None if there is none."""
        method = getattr(self.instance, "getAutonomousCommand", None)
        return method() if callable(method) else None

    def _find_node_at(self, line: int, kind: Any) -> Any:  # a class of nodes
        """The smallest node of a kind on a line of the file in hand."""
        nodes = [one for one in ast.walk(self.tree) if isinstance(one, kind)]
        return next((one for one in nodes[::-1] if one.lineno <= line <= one.end_lineno), None)

    def owner_at(self, line: int) -> str:
        """The class in which a line stands."""
        return getattr(self._find_node_at(line, ast.ClassDef), "name", "")

    def find_statement(self, line: int) -> tuple[int, int] | None:
        """The first and the last line of the statement that a line is in."""
        node = self._find_node_at(line, ast.Assign | ast.AnnAssign | ast.Expr | ast.Return)
        return None if node is None else (node.lineno, node.end_lineno or node.lineno)

    def find_uncalled(self) -> list[tuple[str, int]]:
        """Methods with bindings that nothing calls."""
        methods = [
            one
            for node in self.tree.body
            if isinstance(node, ast.ClassDef)
            for one in node.body
            if isinstance(one, ast.FunctionDef) and any(map(BINDS.match, list_names(one)))
        ]
        every = list_names(self.tree)
        return [(one.name, one.lineno) for one in methods if one.name not in {"__init__", *every}]


def _list_parsable(root: Path) -> Iterator[Path]:
    for one in sorted(root.rglob("*.py")):
        with contextlib.suppress(SyntaxError, ValueError, RecursionError):
            ast.parse(one.read_bytes())
            yield one


def list_names(tree: ast.AST) -> set[str]:
    """The names that stand in a part of a program."""
    nodes = list(ast.walk(tree))
    return {one.id for one in nodes if isinstance(one, ast.Name)} | {
        one.attr for one in nodes if isinstance(one, ast.Attribute)
    }


def _choose_values(parameter: inspect.Parameter) -> list[Any]:
    """The possible arguments of a factory's parameter: constants of an enum, or true and false."""
    kind = parameter.annotation
    if kind is parameter.empty or "Direction" in str(kind):
        from commands2.sysid import SysIdRoutine  # noqa: PLC0415 - whichever is there

        return list(SysIdRoutine.Direction)
    return list_choices(kind)


def _end_loop(*_signal: object) -> None:
    raise EndlessError
