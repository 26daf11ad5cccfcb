"""What would keep a Java file from being compiled, as far as text can tell."""

import re
from collections.abc import Iterator
from typing import TypeVar

from grader.robotcode.button_vocabulary import MODES_OF
from grader.robotcode.compiling.java_types import find_type_errors
from grader.robotcode.compiling.season import (
    CAN_DEVICES,
    DIRECTIONS_OF_2027,
    HOME,
    INHERITED,
    METHODS,
    MODES_OF_2027,
    MOTORS_OF_2027,
    PACKAGES_OF,
    PLAIN,
    PWM_MOTORS,
    SEASON,
    find_season,
    make_spelling_problem,
    suggest_name,
)
from grader.robotcode.facts import ParseProblem
from grader.robotcode.ir import (
    Assign,
    Call,
    Cast,
    Class,
    Function,
    FunctionParameter,
    Import,
    Member,
    Name,
    Node,
    Reference,
    Self,
    Text,
)
from grader.robotcode.name_resolution import (
    find_called_functions,
    find_class,
    find_constructed_class,
    find_methods,
    get_last_name,
    get_simple_type_name,
    infer_type,
)
from grader.robotcode.scope import Scope, walk_with_scopes
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import COMMANDS_V3, UNITS, is_motor

OLD_SEASON = 2026
LANG = frozenset(
    {
        *("String", "Object", "Math", "Double", "Integer", "Boolean", "Float", "Long", "Short"),
        *("Byte", "Character", "Number", "System", "Override", "Deprecated", "SuppressWarnings"),
        *("FunctionalInterface", "SafeVarargs", "Void", "Runnable", "Thread", "Iterable"),
        *("Comparable", "AutoCloseable", "Exception", "RuntimeException", "Error", "Throwable"),
        *("Record", "Enum", "IllegalArgumentException", "IllegalStateException"),
        *("NullPointerException", "StringBuilder", "Class", "UnsupportedOperationException"),
        *("InterruptedException", "StackOverflowError", "CharSequence"),
    }
)
SUBSYSTEM_CLASSES = frozenset({"SubsystemBase", "Mechanism"})
SUBSYSTEM_INTERFACES = frozenset({"Subsystem"})
CONSTRUCTOR = re.compile(
    r"^[ \t]*(?:public|protected|private)\s+(?P<name>[A-Z]\w*)\s*\([^;{}]*\)\s*"
    r"(?:throws\s[\w\s,.]+)?\{",
    re.MULTILINE,
)
BLANK_FINAL = re.compile(
    r"^[ \t]*(?:(?:public|protected|private|static)\s+)*"
    r"final\s+[\w.<>\[\], ]+?\s+(?P<name>\w+)\s*;",
    re.MULTILINE,
)
OWN_BODY = re.compile(  # a class without a name, which may change what any method does
    r"\bnew\s+(?P<type>[A-Z]\w*)\s*\([^;{}()]*(?:\([^;{}()]*\)[^;{}()]*)*\)\s*\{"
)
# A team's package may begin as a library's: com.team254, org.example.
LIBRARIES = (*SEASON, *PACKAGES_OF)
GENERATED = "AutoLogged"  # how the classes end that AdvantageKit writes when it is compiled
AnyNode = TypeVar("AnyNode", bound=Node)
BEFORE_2027 = {old: new for new, old in MOTORS_OF_2027.items()}
DIRECTIONS_BEFORE_2027 = {old: new for new, old in DIRECTIONS_OF_2027.items()}
PACKAGE = re.compile(r"(edu|com|org|java|javax|frc|swervelib|choreo)$")


def find_java_errors(names: SymbolTable) -> Iterator[ParseProblem]:
    """Compile errors of a Java file; none for an excerpt, which has no package."""
    return _JavaFile(names).find_errors() if names.main.package else iter(())


class _JavaFile:
    """What a compiler would refuse in one file.

    Args:
        names: the names of the program.
    """

    def __init__(self, names: SymbolTable) -> None:
        module = names.main
        self.names = names
        self.imports = module.imports
        self.source = module.source.decode("utf-8", errors="replace")
        self.every = list(walk_with_scopes(module.body, Scope(module)))
        made = [one for one, _ in self.each(Assign) if one.declares]
        self.classes = {node.name for node, _ in self.each(Class)}
        self.methods = frozenset(node.name for node, _ in self.each(Function))
        self.called = {node.target for node, _ in self.each(Call)}
        self.variables = {get_last_name(one.target) for one in made}
        self.variables |= {one.name for one, _ in self.each(FunctionParameter)}
        all_of = [_static(one) for one in module.imports if one.name == "*"]
        self.any_member, self.any_class = any(all_of), not all(all_of)  # may be imported by a star

    def each(self, kind: type[AnyNode]) -> Iterator[tuple[AnyNode, Scope]]:
        """The nodes of one kind, each with its scope, in the order of the text."""
        return ((node, scope) for node, scope in self.every if isinstance(node, kind))

    def find_errors(self) -> Iterator[ParseProblem]:
        """Every mistake, kind by kind."""
        yield from self._imports()
        yield from self._replaced()
        yield from find_type_errors(self.names)
        yield from self._file_name()
        yield from self._constructors()
        yield from self._never_set()
        yield from self._inheritance()
        yield from self._runs_of_v3()
        season = find_season(self.imports)
        if season == OLD_SEASON:
            yield from self._names_of_2027()
        elif season:
            yield from self._names_before_2027()
        for node, scope in self.every:
            yield from self._undeclared(node, scope)

    def _undeclared(self, node: Node, scope: Scope) -> Iterator[ParseProblem]:
        """Variables, classes and methods of a node that nothing declares."""
        target = node.target if isinstance(node, Assign) and not node.declares else None
        if isinstance(target, Name) and target.name not in self.variables and self._closed(scope):
            yield ParseProblem(f"{target.name} is not declared", node.place.line)
        for name in _types(node):
            if not self.any_class and not self._is_type(name, scope):
                yield self._unknown_class(name, node.place.line)
        if isinstance(node, Call):
            yield from self._method(node, scope)
        elif isinstance(node, Name) and self._is_value(node):
            yield from self._variable(node, scope)

    def _is_value(self, node: Name) -> bool:
        """Whether a name can be a variable, a constant or a class."""
        method = node in self.called and not node.name[:1].isupper()
        word = node.name in {"super", "this", "_", "length"} or not node.name.isidentifier()
        return not method and not word

    def _names_of_2027(self) -> Iterator[ParseProblem]:
        """Names that came with WPILib 2027, in a program that imports the packages before it."""
        for node, scope in self.each(Member):
            of_mode = node.name in MODES_OF_2027 and get_last_name(node.owner) in MODES_OF
            of_motor = node.name in MOTORS_OF_2027 and is_motor(
                infer_type(node.owner, scope, self.names)
            )
            if of_mode or of_motor:
                old = (MODES_OF_2027 | MOTORS_OF_2027)[node.name]
                said = f"{node.name} is a name of WPILib 2027, and your imports are older"
                yield ParseProblem(f"{said}. Did you mean {old}?", node.place.line, old)

    def _names_before_2027(self) -> Iterator[ParseProblem]:
        """Names that WPILib 2027 no longer has, in a program that imports its packages."""
        for node, scope in self.every:
            line = node.place.line
            if isinstance(node, Call) and isinstance(dict(enumerate(node.args)).get(1), Text):
                made = find_constructed_class(node, scope, self.names)
                if made in CAN_DEVICES:
                    # Phoenix 6, 25.90.0-alpha-2: no constructor takes the bus as text any more.
                    said = f"for WPILib 2027, {made} takes a CANBus, and no text: new CANBus(...)"
                    yield ParseProblem(said, line)
            new = self._name_of_2027(node, scope) if isinstance(node, Member) else ""
            if new:
                said = f"WPILib 2027 has no {get_last_name(node)} here."
                yield ParseProblem(f"{said} Did you mean {new}?", line, new)

    def _name_of_2027(self, node: Member, scope: Scope) -> str:
        """The 2027 name of a member of an older WPILib; empty if the member is another one."""
        if node.name in BEFORE_2027:
            type_ = get_simple_type_name(infer_type(node.owner, scope, self.names))
            own = self.names.find_by_name(type_, scope) is not None
            return BEFORE_2027[node.name] if type_ in PWM_MOTORS and not own else ""
        of_direction = get_last_name(node.owner) == "Direction"
        return DIRECTIONS_BEFORE_2027.get(node.name, "") if of_direction else ""

    def _file_name(self) -> Iterator[ParseProblem]:
        """A public class with a typing error in its name, which Java wants to be the file's."""
        stem = self.names.main.path.stem
        for node in self.names.main.body:
            public = isinstance(node, Class) and node.place.text.startswith("public")
            if public and isinstance(node, Class) and suggest_name(node.name, frozenset({stem})):
                said = f"the class is called {node.name}, and its file {stem}: "
                yield ParseProblem(f"{said}give both the same name", node.place.line)

    def _runs_of_v3(self) -> Iterator[ParseProblem]:
        """Calls of ``run`` in a Mechanism of Commands v3 whose lambda takes no coroutine."""
        if not any(one.path.startswith(COMMANDS_V3) for one in self.imports):
            return
        for node, scope in self.each(Call):
            if get_last_name(node.target) != "run" or len(node.args) != 1:
                continue
            owner = node.target.owner if isinstance(node.target, Member) else Self(node.place)
            given = node.args[0]
            own = isinstance(owner, Self) and not find_called_functions(node, scope, self.names)
            if own and isinstance(given, Function) and not given.parameters:
                said = "run() of a Mechanism takes a coroutine: run(coroutine -> ...), or "
                yield ParseProblem(f"{said}runRepeatedly", node.place.line)

    def _inheritance(self) -> Iterator[ParseProblem]:
        """Classes of the command library that are implemented, and interfaces that are extended."""
        for node, scope in self.each(Class):
            head = node.place.text.partition("{")[0]
            extended, _, implemented = head.partition("implements")
            for part, kinds, cure in (
                (implemented, SUBSYSTEM_CLASSES, "a class: write extends"),
                (extended.partition("extends")[2], SUBSYSTEM_INTERFACES,
                 "an interface: write implements"),
            ):  # fmt: skip
                for base in re.findall(r"\w+", re.sub(r"<.*>", "", part)):
                    if base in kinds and self._is_of_library(base, scope):
                        yield ParseProblem(f"{base} is {cure} {base}", node.place.line)

    def _is_of_library(self, name: str, scope: Scope) -> bool:
        found = any(one.name == name and one.path.startswith(LIBRARIES) for one in self.imports)
        return found and self.names.find_by_name(name, scope) is None

    def _constructors(self) -> Iterator[ParseProblem]:
        """What looks like a constructor, and is called unlike every class here."""
        classes = set(re.findall(r"\b(?:class|enum|record|interface)\s+(\w+)", self.source))
        for found in CONSTRUCTOR.finditer(self.source):
            if found["name"] not in classes:
                said = f"{found['name']}() has no return type, and no class has this name"
                yield ParseProblem(said, self._line_at(found.start("name")))

    def _never_set(self) -> Iterator[ParseProblem]:
        """Final fields that get no value."""
        for found in BLANK_FINAL.finditer(self.source):
            name = found["name"]
            if not re.search(rf"\b{name}\s*=(?!=)", self.source):
                said = f"{name} is final and never gets a value"
                yield ParseProblem(said, self._line_at(found.start("name")))

    def _line_at(self, place: int) -> int:
        return self.source.count("\n", 0, place) + 1

    def _line_of(self, one: Import) -> int:
        """The line that an import stands on."""
        path = re.escape(one.path) + (r"\.\*" if one.name == "*" else "")
        found = re.search(rf"(?m)^[^\S\n]*import\s+(static\s+)?{path}\s*;", self.source)
        return self._line_at(found.start()) if found else 1

    def _imports(self) -> Iterator[ParseProblem]:
        for one in self.imports:
            owner, _, name = one.path.rpartition(".")
            if owner.rpartition(".")[2] == "Units" and name[:1].isupper() and "units" in owner:
                meant = suggest_name(name, frozenset(UNITS))
                if meant:
                    line = self._line_of(one)
                    yield make_spelling_problem("unit", name, meant=meant, line=line)
            elif one.name != "*" and one.path.startswith(SEASON):
                meant, line = suggest_name(name, HOME), self._line_of(one)
                if meant:
                    yield make_spelling_problem("class", name, meant=meant, line=line)
                elif name in HOME and not HOME[name].startswith(owner):
                    yield ParseProblem(f"{name} is not in {owner}: it is in {HOME[name]}", line)

    def _replaced(self) -> Iterator[ParseProblem]:
        """Classes and units of WPILib and of vendors that are replaced by code that is not here."""
        team = f"{self.names.main.package.partition('.')[0]}."
        for one in self.imports:
            name = one.path.rpartition(".")[2]
            own = one.path.startswith(team) and not one.path.startswith(LIBRARIES)
            known = name in HOME or name in UNITS or is_motor(name)
            if own and known and self.names.find_by_name(name, Scope(self.names.main)) is None:
                said = f"{one.path} is not the {name} of WPILib or of its vendor"
                yield ParseProblem(said, self._line_of(one))
        for found in OWN_BODY.finditer(self.source):
            if is_motor(found["type"]):
                said = f"this {found['type']} has methods of its own. Make it without them"
                yield ParseProblem(said, self._line_at(found.start()))

    def _is_imported(self, name: str) -> bool:
        return any(one.name == name for one in self.imports)

    def _is_type(self, name: str, scope: Scope) -> bool:
        if name in self.classes or name in LANG or self._is_imported(name):
            return True
        if name.endswith(GENERATED):
            return True
        nested = re.search(rf"[A-Z]\w*\.{name}\b", self.source) and not scope.classes
        if nested and any(one.name == "*" or one.name[:1].isupper() for one in self.imports):
            return True
        return self.names.find_by_name(name, scope) is not None

    def _unknown_class(self, name: str, line: int) -> ParseProblem:
        # WPILib 2027 moved its classes: the packages that HOME knows are those before it.
        moved = find_season(self.imports) > OLD_SEASON
        if moved and HOME.get(name, "").startswith("edu.wpi."):
            return ParseProblem(f"{name} is not imported", line)
        if name in HOME:
            return ParseProblem(f"{name} is not imported: import {HOME[name]}.{name};", line)
        meant = suggest_name(name, HOME)
        if meant:
            return make_spelling_problem("class", name, meant=meant, line=line)
        return ParseProblem(f"{name} is not imported", line)

    def _variable(self, node: Name, scope: Scope) -> Iterator[ParseProblem]:
        name, line = node.name, node.place.line
        if self._is_known(node, scope):
            return
        if name in UNITS:
            if not self.any_member:
                yield ParseProblem(f"the unit {name} is not imported", line)
        elif name[:1].isupper() and not re.fullmatch(r"[A-Z][A-Z0-9_]*", name):
            if not self.any_class and not self._is_type(name, scope):
                yield self._unknown_class(name, line)
        elif not self.any_member and self._closed(scope) and _is_plain(node, scope):
            yield ParseProblem(f"{name} is not declared", line)

    def _is_known(self, node: Name, scope: Scope) -> bool:
        """Whether a name is declared or imported, or is the beginning of a package."""
        return bool(
            self.names.find_local(node.name, scope)
            or self.names.find_definitions(node, scope)
            or PACKAGE.match(node.name)
            or self._is_imported(node.name)
            or node.name in self.classes
            or self._is_field(node.name, scope)
            or _is_case(node)
        )

    def _is_field(self, name: str, scope: Scope) -> bool:
        for home in scope.homes:
            if any(name in self.names.find_fields(at) for at in self.names.list_base_classes(home)):
                return True
            if "enum" in home.classes[-1].place.text:
                return True
        return False

    def _closed(self, scope: Scope) -> bool:
        """Whether all that the classes around inherit is known."""
        return all(
            get_simple_type_name(base) in PLAIN
            or self.names.find_by_name(get_simple_type_name(base), place) is not None
            for home in scope.homes
            for place in self.names.list_base_classes(home)
            for base in place.classes[-1].bases
        )

    def _method(self, call: Call, scope: Scope) -> Iterator[ParseProblem]:
        """What a compiler says of a call."""
        target = call.target
        own = find_called_functions(call, scope, self.names)
        if own or isinstance(target, Reference):
            return
        if isinstance(target, Member):
            yield from self._method_of(target, scope)
        elif isinstance(target, Name) and target.name[:1].islower():
            known = target.name in INHERITED | self.methods or self._is_imported(target.name)
            if not known and not self.any_member and self._closed(scope) and scope.classes:
                said = f"the method {target.name}() is not declared"
                yield ParseProblem(said, target.place.line)

    def _method_of(self, target: Member, scope: Scope) -> Iterator[ParseProblem]:
        """What a compiler says of a method of some object that these files do not hold."""
        made = target.name[:1].isupper() and self.names.find_home(
            target, scope
        )  # new Outer.Inner()
        if isinstance(target.owner, Self) or made:
            return
        home = find_class(target.owner, scope, self.names)
        if home is not None and home.classes and self._closed(home):
            there = find_methods(target.name, home, self.names) or target.name in INHERITED
            record = home.classes[-1].place.text.split("{")[0]
            if not there and "enum" not in record and "record" not in record:
                yield self._missing_method(target, home)
        elif target.name not in self.methods and target.name[:1].islower():
            meant, line = suggest_name(target.name, METHODS), target.place.line
            if meant:
                yield make_spelling_problem("method", target.name, meant=meant, line=line)

    def _missing_method(self, target: Member, home: Scope) -> ParseProblem:
        """A method that a class in sight does not have."""
        line = target.place.line
        own = frozenset(
            node.name
            for place in self.names.list_base_classes(home)
            for node in place.classes[-1].body
            if isinstance(node, Function)
        )
        meant = suggest_name(target.name, own | METHODS)
        if meant:
            return make_spelling_problem("method", target.name, meant=meant, line=line)
        return ParseProblem(f"{home.classes[-1].name} has no method {target.name}()", line)


def _static(one: Import) -> bool:
    """Whether an import brings in members of a class: ``Units.*``."""
    return one.path.rpartition(".")[2][:1].isupper()


def _types(node: Node) -> Iterator[str]:
    """The classes that a declaration names, without those that stand behind a dot."""
    written = ""
    if isinstance(node, Assign | FunctionParameter | Function | Cast):
        written = node.type
    elif isinstance(node, Class):
        written = " ".join(base for base in node.bases if base[:1].isupper())
    yield from re.findall(r"(?<![\w.])[A-Z]\w+", written)


def _is_case(node: Name) -> bool:
    """Whether a name is a constant that a ``case`` of a switch stands for."""
    source = node.place.source[max(node.place.start - 80, 0) : node.place.start]
    return bool(re.search(rb"\bcase\s+([\w.]+\s*,\s*)*$", source))


def _is_plain(node: Name, scope: Scope) -> bool:
    """Whether a name stands where only a variable can: not a method's name, nor a label."""
    source, end = node.place.source, node.place.end
    after = source[end : end + 40].lstrip()[:2]
    before = source[max(node.place.start - 40, 0) : node.place.start].rstrip()
    label = before.endswith((b"case", b"@", b"enum", b"::")) or after.startswith(b"->")
    return bool(scope.functions or scope.classes) and not label and not after.startswith(b"(")
