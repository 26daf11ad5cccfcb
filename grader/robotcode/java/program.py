"""The files of a Java program, the classes in them, and the meaning of names."""

import difflib
import functools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tree_sitter import Node

from grader.robotcode.java import type_names, values
from grader.robotcode.java.classes import DECLARATIONS, JavaClass
from grader.robotcode.java.scope import named, text
from grader.robotcode.java.steps import STATE
from grader.robotcode.java.syntax import At, Source
from grader.robotcode.library import JAVA
from grader.robotcode.library.base import Unknown
from grader.robotcode.problems import ParseProblem
from grader.robotcode.project import list_sources
from grader.robotcode.source import read_source
from sim.core.errors import UnreadableFile

BOM = b"\xef\xbb\xbf"
NEARLY = 0.84  # how much of two class names has to agree, from 0 to 1
# Packages whose classes are all where the library says, and nowhere else.
VENDORS = ("edu.wpi.first.", "com.ctre.phoenix6.", "com.revrobotics.", "java.util.", "org.wpilib.")
OLD = ("com.ctre.phoenix.", "edu.wpi.first.wpilibj.command.")  # what newer packages replace
GENERATED = "AutoLogged"
RENAMED = {"org.wpilib.": "edu.wpi.first."}  # in 2027
_BY_NAME: dict[str, list[str]] = {}


def packages_of(name: str) -> list[str]:
    """The full names of the libraries' classes that have a simple name."""
    if not _BY_NAME:
        for full in JAVA:
            _BY_NAME.setdefault(full.rpartition(".")[2], []).append(full)
    return _BY_NAME.get(name, [])


@dataclass(frozen=True)
class Import:
    """An import: the imported name, whether it is static, whether it ends in a star."""

    full: str
    static: bool
    star: bool
    at: At

    @property
    def name(self) -> str:
        """The simple name that it brings."""
        return self.full.rpartition(".")[2]


@dataclass(eq=False)
class Unit:
    """One file of the program."""

    program: "Program"
    source: Source
    package: str = ""
    imports: list[Import] = field(default_factory=list)
    classes: dict[str, JavaClass] = field(default_factory=dict)

    def __post_init__(self) -> None:
        root = self.source.root
        for one in named(root) if root is not None else ():
            if one.type == "package_declaration":
                self.package = re.sub(r"^package|[\s;]", "", text(one))
            elif one.type == "import_declaration":
                self.imports.append(_read_import(one, self.source.at(one)))
            elif one.type in DECLARATIONS:
                name = text(one.child_by_field_name("name"))
                self.classes[name] = JavaClass(name, one, self)


def _read_import(node: Node, at: At) -> Import:
    words = re.sub(r"/\*.*?\*/|//[^\n]*", " ", text(node)).replace(";", " ").split()
    static = "static" in words
    full = "".join(word for word in words if word not in {"import", "static"})
    return Import(full.removesuffix(".*"), static, full.endswith(".*"), at)


class Program:
    """A Java program: the file in hand, and those that names lead to.

    Args:
        path: the file in hand.

    Raises:
        UnreadableFile: it is no readable source text, or does not parse.
    """

    def __init__(self, path: Path, *, source: Source | None = None) -> None:
        STATE.start()
        self.path = path
        self._on_disk = source is None
        self.main = source or Source(path, read_source(path))
        problem = self.main.problem
        if problem is not None:
            raise UnreadableFile(
                problem.message,
                where=f"{path}, line {problem.line}",
                advice="Fix that line first: code with a mistake like this does not compile.",
            )
        self.errors: dict[tuple[str, int, str], ParseProblem] = {}  # what javac would say
        self.unknown: dict[str, At] = {}  # classes that nobody knows, and where
        self._units: dict[Path, Unit | None] = {}
        self._resolved: dict[tuple[Any, ...], Any] = {}
        self.unit = Unit(self, self.main)
        if source is None and path.read_bytes().startswith(BOM):
            at = At(1, path.name)
            self.error(
                "the file begins with a byte order mark, an invisible sign that javac refuses. "
                "Save it as UTF-8 without BOM",
                at,
            )
        self._units[path] = self.unit

    def compile_all(self) -> None:
        """Compile every class of the file in hand, so that its errors are known."""
        waiting = list(self.unit.classes.values())
        while waiting:
            one = waiting.pop(0)
            _ = one.cls
            waiting += one.nested.values()
        for imported in self.unit.imports:
            self._check_import(imported)

    def error(self, message: str, at: At, call: str = "") -> None:
        """Record an error that javac would report; once for a call, also if it is in a loop."""
        other = "" if at.file == self.main.path.name else at.file
        self.errors.setdefault(
            (other, int(at), call or message), ParseProblem(message, int(at), other)
        )

    # -- files ------------------------------------------------------------------------------

    @functools.cached_property
    def _files_by_stem(self) -> dict[str, list[Path]]:
        found: dict[str, list[Path]] = {}
        for one in list_sources(self.path, self.unit.package, ".java") if self._on_disk else ():
            found.setdefault(one.stem, []).append(one)
        return found

    def _find_unit(self, path: Path) -> Unit | None:
        """Another file, parsed; None if it cannot be read. A syntax error in it is recorded."""
        if path not in self._units:
            self._units[path] = None
            try:
                source = Source(path, read_source(path))
                problem = source.problem
                if problem is None:
                    self._units[path] = Unit(self, source)
                else:
                    self.error(problem.message, At(problem.line, path.name))
            except UnreadableFile:
                pass
        return self._units[path]

    def list_all_units(self) -> list[Unit]:
        """Every file of the program that can be read."""
        paths = [self.path, *(one for several in self._files_by_stem.values() for one in several)]
        return [unit for unit in map(self._find_unit, paths) if unit is not None]

    def find_own(self, full: str) -> JavaClass | None:
        """A class of the program by its full name: ``frc.robot.Constants.Drive``."""
        words = full.split(".")
        for at, word in enumerate(words):
            if not word[:1].isupper():
                continue
            package = ".".join(words[:at])
            units = [self._find_unit(path) for path in self._files_by_stem.get(word, ())]
            found = [one for one in units if one is not None and word in one.classes]
            exact = [one for one in found if one.package == package]
            one = next(iter(exact or (found if len(found) == 1 else ())), None)
            top: Any = None if one is None else one.classes[word]
            for inner in words[at + 1 :]:
                top = top.nested.get(inner) if top is not None else None
            return top
        return None

    def _find_neighbor(self, name: str, unit: Unit) -> JavaClass | None:
        """A class in the same package, in any file."""
        found = self.find_own(f"{unit.package}.{name}")
        if found is not None and found.unit.package == unit.package:
            return found
        for path in (one for several in self._files_by_stem.values() for one in several):
            if path.parent == unit.source.path.parent and _mentions_name(path, name):
                other = self._find_unit(path)
                if other is not None and other.package == unit.package and name in other.classes:
                    return other.classes[name]
        return None

    def _find_logged(self, name: str, scope: JavaClass) -> Any:
        """A class that AdvantageKit adds to, also one within another class of the package."""
        found = self._resolve_simple(name, scope)
        if found is not None:
            return found
        paths = [one for several in self._files_by_stem.values() for one in several]
        for path in paths:
            unit = self._find_unit(path) if _mentions_name(path, name) else None
            if unit is not None and unit.package == scope.unit.package:
                for one in unit.classes.values():
                    if name in one.nested:
                        return one.nested[name]
        return None

    # -- names ------------------------------------------------------------------------------

    def load(self, full: str) -> Any:
        """A class by its full name: the program's own, a library's, or None."""
        own = self.find_own(full)
        if own is not None:
            return own
        for old, new in (("", ""), *RENAMED.items()):
            found = _find_library(new + full.removeprefix(old)) if full.startswith(old) else None
            if found is not None:
                return found
        if full.startswith("org.wpilib."):
            here = packages_of(full.rpartition(".")[2])
            if here:
                return JAVA[here[0]]
        return None

    def resolve(self, name: str, scope: JavaClass, frame: Any = None) -> Any:
        """The class that a name stands for in a class.

        Args:
            name: simple or with points; brackets of arrays are left out.
            scope: the class whose text uses it.
            frame: the method, for local classes.

        Returns:
            A JavaClass, a library's class, an Unknown, or None if nothing has this name.
        """
        name = name.rstrip("[]")
        local = frame
        while local is not None:
            found = local.find_class(name.partition(".")[0])
            if found is not None:
                return _find_inner_class(found, name.split(".")[1:])
            local = local.outer
        key = (name, scope)
        if key not in self._resolved:
            self._resolved[key] = None  # while it is looked for
            first, *rest = name.split(".")
            found = self._resolve_simple(first, scope)
            if found is None and rest:
                found, rest = self.load(name), []
            self._resolved[key] = _find_inner_class(found, rest)
        return self._resolved[key]

    def _resolve_simple(self, name: str, scope: JavaClass) -> Any:
        one: JavaClass | None = scope
        while one is not None:
            if one.name == name and name:
                return one
            found = one.find_nested(name)
            if found is None and one.frame is not None:
                found = self.resolve(name, one.frame.owner, one.frame)
            if found is not None:
                return found
            one = one.outer
        unit = scope.unit
        if name in unit.classes:
            return unit.classes[name]
        for imported in unit.imports:
            if imported.name == name and not imported.star:
                found = self.load(imported.full)
                if found is not None or not imported.static:
                    return (
                        found
                        if found is not None
                        else self._make_unknown(imported.full, imported.at)
                    )
        found = self._find_neighbor(name, unit)
        if found is None and name.endswith(GENERATED):  # by AdvantageKit, of a class with @AutoLog
            found = self._find_logged(name.removesuffix(GENERATED), scope)
        if found is not None:
            return found
        for imported in unit.imports:
            if imported.star:
                found = self.load(f"{imported.full}.{name}")
                if found is not None:
                    return found
        return JAVA.get(f"java.lang.{name}")

    def _make_unknown(self, full: str, at: At) -> Unknown:
        self.unknown.setdefault(full, at)
        return Unknown(full.rpartition(".")[2])

    def _check_import(self, one: Import) -> None:
        """Report an import of a class that is in another package, or does not exist."""
        full = one.full.rpartition(".")[0] if one.static and not one.star else one.full
        if one.star and not one.static:
            return
        found = self.load(full)
        if one.static and not one.star and getattr(found, "fake_complete", False):
            names = [*dir(found), *found.fake_others]
            if one.name not in names:
                near = type_names.did_you_mean(one.name, names)
                self.error(f"there is no {one.name} in {full}{near}", one.at)
        if found is not None or not full.startswith(VENDORS):
            return
        name = full.rpartition(".")[2]
        root = full.partition(".")[0]  # java's own, or a library's: each knows only its own names
        elsewhere = [one for one in packages_of(name) if one.startswith(root)]
        same = [known for known in JAVA if known.rpartition(".")[0] == full.rpartition(".")[0]]
        close = difflib.get_close_matches(name, [k.rpartition(".")[2] for k in same], 1, NEARLY)
        if elsewhere:
            best = min(elsewhere, key=lambda known: _rate_likeness(known, self.unit))
            self.error(f"there is no {full}; {name} is {best}", one.at)
        elif close:
            self.error(f"there is no {name}. Did you mean {close[0]}?", one.at)

    def resolve_or_report(self, name: str, scope: JavaClass, at: At, frame: Any = None) -> Any:
        """The class of a name; if there is none, an error is reported and it is unknown."""
        found = self.resolve(name, scope, frame)
        if found is not None:
            return found
        first, *rest = name.rstrip("[]").split(".")
        whole = self.resolve(first, scope, frame) if rest else None
        if isinstance(whole, type):
            inner = [key for key, one in vars(whole).items() if isinstance(one, type)]
            near = type_names.did_you_mean(rest[0], inner)
            self.error(f"{whole.__name__} has no {rest[0]}{near}", at)
            return (
                _find_inner_class(whole, [near.rpartition(" ")[2].rstrip("?")]) if near else whole
            )
        loaded = [(one.full, self.load(one.full)) for one in scope.unit.imports]
        nested = {f"{full}.{first}": _find_inner_class(cls, [first]) for full, cls in loaded}
        elsewhere = {full: JAVA[full] for full in packages_of(first)}
        elsewhere |= {full: cls for full, cls in nested.items() if isinstance(cls, type)}
        if elsewhere:
            best = min(elsewhere, key=lambda full: _rate_likeness(full, scope.unit))
            self.error(f"{first} is not imported. Write at the top: import {best};", at)
            return _find_inner_class(elsewhere[best], rest)
        simple = [full.rpartition(".")[2] for full in JAVA if full.startswith(VENDORS)]
        close = difflib.get_close_matches(first, simple, 1, NEARLY)
        if close:
            self.error(f"there is no class {first}. Did you mean {close[0]}?", at)
            return _find_inner_class(JAVA[packages_of(close[0])[0]], rest)
        return self._make_unknown(name, at)


def _rate_likeness(full: str, unit: Unit) -> tuple[bool, int]:
    """The smaller, the likelier a class is meant: not an old one, and of a library that is used."""
    package = full.rpartition(".")[0]
    old = package.startswith(OLD) or package == "com.revrobotics"
    return old, -sum(one.full.startswith(package[:14]) for one in unit.imports)


def _mentions_name(path: Path, name: str) -> bool:
    try:
        return name.encode() in path.read_bytes()
    except OSError:
        return False


def _find_library(full: str) -> Any:
    words = full.split(".")
    for length in range(len(words), 1, -1):
        top = JAVA.get(".".join(words[:length]))
        if top is not None:
            return _find_inner_class(top, words[length:])
    return None


def _find_inner_class(found: Any, names: list[str]) -> Any:
    """A class within classes."""
    for name in names:
        if isinstance(found, JavaClass):
            found = found.find_nested(name)
        elif isinstance(found, type):
            inner = next((c.__dict__[name] for c in found.__mro__ if name in c.__dict__), None)
            found = inner if isinstance(inner, type) else None
    return found


def iterate(value: Any) -> Iterator[Any]:
    """The values that a for-each loop iterates over.

    Raises:
        NullPointerException: it is null.
    """
    if value is None:
        raise values.NullPointerException("null cannot be looped over")
    return iter(value if isinstance(value, Iterable) else Unknown("what is looped over"))
