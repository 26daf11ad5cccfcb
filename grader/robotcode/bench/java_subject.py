"""A Java program on the bench: its class is made as a robot's program would make it."""

import contextlib
import enum
import functools
import itertools
import re
import sys
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any

from grader.robotcode.bench.button_run import Factory
from grader.robotcode.bench.facts import Outcome
from grader.robotcode.bench.simulation import walk_fields
from grader.robotcode.bench.subject import Subject, list_choices, list_made, make_library_object
from grader.robotcode.java import type_names, values
from grader.robotcode.java.classes import DECLARATIONS, JavaClass, Method
from grader.robotcode.java.lang import Exited
from grader.robotcode.java.program import Program
from grader.robotcode.java.runtime import STATE, EndlessError
from grader.robotcode.java.scope import text
from grader.robotcode.java.steps import CannotRunError, allow_deep_calls
from grader.robotcode.java.syntax import At
from grader.robotcode.java.values import PRIMITIVES
from grader.robotcode.library.base import NoSuchMember, Unknown, WrongArgument
from grader.robotcode.library.commands import IllegalCommandUse
from grader.robotcode.library.world import WORLD

START_STEPS = 100_000  # calls and turns of loops until the robot's class is made
TESTING = frozenset({"SysIdRoutine", "Command"})  # types of what starts a test
STATEMENTS = frozenset({
    "expression_statement", "field_declaration", "local_variable_declaration", "return_statement",
})  # fmt: skip
DEEP = 3  # constructors within constructors that are given what they ask for


class JavaSubject(Subject):
    """A Java program, and the one of its classes that is looked at.

    Args:
        path: the file in hand.
        wanted: text that tells the class from others of the file.

    Raises:
        UnreadableFile: it is no readable source text.
    """

    language = "java"

    def __init__(self, path: Path, wanted: str = "SysIdRoutine") -> None:
        allow_deep_calls()
        WORLD.where = lambda: STATE.at
        WORLD.stack = self.list_calls
        STATE.refill()
        self.program = Program(path)
        self.java: Any = self._choose_class(wanted)  # None if the file has no class
        self.name = self.java.name if self.java is not None else path.stem
        self.text = self.program.main.text

    @property
    def season(self) -> int:
        """The season of WPILib whose packages are imported."""
        new = any(one.full.startswith("org.wpilib.") for one in self.program.unit.imports)
        return 2027 if new else 2026

    def _choose_class(self, wanted: str) -> JavaClass | None:
        classes = list(self.program.unit.classes.values())
        if not classes:
            return None
        public = next((one for one in classes if one.name == self.program.path.stem), classes[0])
        if not wanted or wanted in (public.node.text or b"").decode():
            return public
        return next((one for one in classes if wanted in (one.node.text or b"").decode()), public)

    def start(self) -> None:
        """Make the class, with its constructor or by its own ``getInstance``."""
        STATE.refill(START_STEPS)
        self.program.compile_all()
        if self.java is None:
            return
        _ = self.java.cls
        if self.java.constructors and all(one.kinds for one in self.java.constructors):
            self.instance = self._find_program_instance(self.java.name)
            if self.instance is not None:
                return
        made = [
            one for one in self.java.methods
            if one.static and not one.kinds and one.returns == self.java.name
        ]  # fmt: skip
        private = all("private" in one.modifiers for one in self.java.constructors)
        if made and private and self.java.constructors:
            self.java.initialize()
            self.instance = made[0].run(None)
        elif "abstract" in self.java.modifiers:
            self.instance = self._make_one_of(self.java, 0)
        else:
            self.instance = self.make(self.java)

    def _find_program_instance(self, name: str) -> Any:
        """The object of a class that another class of the program makes, as a container does."""
        for java in self._list_classes():
            source = (java.node.text or b"").decode()
            if java.outer is None and java.name != name and re.search(rf"\bnew {name}\(", source):
                _ = java.cls
                if not java.constructors or any(not one.kinds for one in java.constructors):
                    holder = java.make(())
                    found = (one for _, _, one in walk_fields(holder) if type(one).__name__ == name)
                    return next(found, None)
        return None

    def make(self, java: JavaClass, depth: int = 0) -> Any:
        """An object of a class; its constructor gets the same kind of arguments as on a robot."""
        _ = java.cls
        best: Method | None = min(java.constructors, key=lambda one: len(one.kinds), default=None)
        args = [
            self._make_argument(kind, java, depth)
            for kind in (best.kinds if best is not None else ())
        ]
        env = (
            None if java.static or java.outer is None else [self.make(java.outer, depth + 1), None]
        )
        return java.make(args, (), env)

    def _make_argument(self, kind: str, java: JavaClass, depth: int) -> Any:
        if kind in PRIMITIVES:
            return values.cast(kind, 1) if kind != "boolean" else False
        if kind == "String":
            return "name"
        if kind.endswith("[]"):
            return values.Array([], kind[:-2])
        found = self.program.resolve(kind, java)
        if isinstance(found, JavaClass) and depth < DEEP:
            return self._make_one_of(found, depth)
        if isinstance(found, type):
            return make_library_object(found)
        return Unknown(kind)

    def _make_one_of(self, java: JavaClass, depth: int) -> Any:
        if java.form == "enum":
            java.initialize()
            return next(iter(java.statics.values()), None)
        if _is_concrete(java):
            return self.make(java, depth + 1)
        every = [one for one in self._list_classes() if one is not java and java in one.ancestors()]
        children = [one for one in every if _is_concrete(one)]
        children.sort(key=lambda one: bool(re.search(r"Sim|Replay|Mock", one.name)))
        if children or java.form != "class":
            return self.make(children[0], depth + 1) if children else Unknown(java.name)
        java.modifiers -= {"abstract"}  # what it has itself can be looked at
        return self.make(java, depth + 1)

    def _list_classes(self) -> list[JavaClass]:
        waiting = [one for unit in self.program.list_all_units() for one in unit.classes.values()]
        found = []
        while waiting:
            one = waiting.pop(0)
            found.append(one)
            waiting += one.nested.values()
        return found

    def find_routines(self) -> list[Any]:
        """The routines that a method makes when somebody asks for one, or for a test."""
        return list_made("routines", self._ask_methods)

    def _ask_methods(self) -> None:
        for one in self.java.methods if self.java is not None else ():
            told = one.returns in TESTING and "private" not in one.modifiers
            if told and all(kind.rpartition(".")[2] == "Direction" for kind in one.kinds):
                args = [self._find_direction(kind) for kind in one.kinds]
                one.run(None if one.static else self.instance, *args)

    def _find_direction(self, kind: str) -> Any:
        found = self.program.resolve(kind, self.java)
        return next(iter(found)) if isinstance(found, enum.EnumMeta) else Unknown(kind)

    @staticmethod
    def refill() -> None:
        """Give the program a new budget of steps, for the next loop."""
        STATE.refill()

    @staticmethod
    def explain(error: BaseException) -> tuple[Outcome, str, int, str]:
        """The error that ended the program, with its line."""
        line = int(STATE.at)
        if isinstance(error, EndlessError):
            return Outcome.ENDLESS, "the code here runs without end", line, "endless"
        if isinstance(error, CannotRunError):
            advice = "write it in another way, or show a mentor"
            said = f"the grader cannot run line {line}, {error}: {advice}"
            return Outcome.CANNOT, said, line, "unknown"
        if isinstance(error, values.Throwable):
            return Outcome.CRASHED, str(error), line, type_names.type_name(type(error))
        if isinstance(error, RecursionError):
            return Outcome.CRASHED, "java.lang.StackOverflowError", line, "StackOverflowError"
        if isinstance(error, Exited):
            return Outcome.CRASHED, "System.exit() ends the program", line, "exit"
        if isinstance(error, WrongArgument | NoSuchMember | IllegalCommandUse):
            return Outcome.CRASHED, str(error), line, type(error).__name__
        raise error  # ours, and no fault of the learner's

    def describe(self) -> dict[str, Any]:
        """The facts that the program's text tells without running it."""
        unknown = {n: int(at) for n, at in (WORLD.undecided | self.program.unknown).items()}
        return {
            "errors": tuple(self.program.errors.values()),
            "unknown": unknown,
        }

    # -- buttons ----------------------------------------------------------------------------

    def list_factories(self) -> list[Factory]:
        """The methods that give commands, with the tests that they made when they were called."""
        found = []
        for java, instance in self._list_instances().items():
            for one in java.methods:
                if "Command" not in one.returns and one.returns not in {"", "var"}:
                    continue
                tests = tuple(self._call_factory(one, instance))
                if tests:
                    public = "public" in one.modifiers or java.form == "interface"
                    found.append(Factory(java.name, one.name, public, int(one.at), tests))
        return found

    def _list_instances(self) -> dict[JavaClass, Any]:
        found: dict[JavaClass, Any] = {}
        for _, _, one in walk_fields(self.instance):
            java = getattr(type(one), "java", None)
            if java is not None:
                found.setdefault(java, one)
        return found

    def _call_factory(self, method: Method, instance: Any) -> Iterator[str]:
        """The tests that a method makes, for each value of its parameters."""
        choices = []
        for kind in method.kinds:
            values_ = self._list_choices(kind, method.owner)
            if not values_:
                return
            choices.append(values_)
        for args in itertools.product(*choices):
            this = None if method.static else instance
            with contextlib.suppress(values.Throwable, TypeError, ValueError, AttributeError):
                made = list_made("tests", functools.partial(method.run, this, *args))
                yield from (test for test, _, _ in made)

    def _list_choices(self, kind: str, scope: JavaClass) -> list[Any]:
        found = self.program.resolve(kind, scope)
        if isinstance(found, JavaClass) and found.form == "enum":
            return found.list_constants()
        return list_choices(bool if kind == "boolean" else found)

    def autonomous(self) -> Any:
        """The command of autonomous; None if there is none."""
        methods = self.java.methods if self.java is not None else ()
        method = next(
            (m for m in methods if m.name == "getAutonomousCommand" and not m.kinds), None
        )
        return method.run(self.instance) if method is not None else None

    def owner_at(self, line: int) -> str:
        """The class in which a line stands."""
        node = self._find_node_at(line, DECLARATIONS)
        return text(node.child_by_field_name("name")) if node is not None else ""

    def _find_node_at(self, line: int, kinds: Collection[str]) -> Any:
        """The smallest node of some kinds on a line of the file in hand."""
        found: Any = None
        waiting: list[Any] = [self.program.main.root]
        while waiting:
            node = waiting.pop()
            if node.start_point[0] <= line - 1 <= node.end_point[0]:
                found = node if node.type in kinds else found
                waiting += node.children
        return found

    def list_calls(self) -> list[int]:
        """The lines of the calls that led here, the innermost first; 0 in another file."""
        found: list[int] = []
        frame: Any = sys._getframe(1)  # Python's own frames
        while frame is not None:
            if frame.f_globals.get("__package__") == "grader.robotcode.java":
                at = frame.f_locals.get("at")
                line = int(at) if getattr(at, "file", "") == self.program.main.path.name else 0
                if isinstance(at, At) and (not found or found[-1] != line):
                    found.append(line)
            frame = frame.f_back
        return found

    def find_statement(self, line: int) -> tuple[int, int] | None:
        """The first and the last line of the statement that a line is in."""
        node = self._find_node_at(line, STATEMENTS)
        return None if node is None else (node.start_point[0] + 1, node.end_point[0] + 1)

    def find_uncalled(self) -> list[tuple[str, int]]:
        """Methods with bindings that nothing calls."""
        whole = self.program.main.text
        found = []
        for java in self._list_classes():
            for one in java.methods if "cls" in java.__dict__ else ():
                binds = re.search(
                    r"\.(while|on|toggleOn)(True|False)\(", (one.node.text or b"").decode()
                )
                if binds and len(re.findall(rf"\b{one.name}\b", whole)) == 1:
                    found.append((one.name, int(one.at)))
        return found


def _is_concrete(java: JavaClass) -> bool:
    """Whether objects of a class can be made."""
    return java.form == "class" and "abstract" not in java.modifiers
