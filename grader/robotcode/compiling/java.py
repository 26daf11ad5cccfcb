"""What would keep a Java file from being compiled, as far as text can tell."""

import re
from collections.abc import Iterator

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
PACKAGE = re.compile(r"(edu|com|org|java|javax|frc|swervelib|choreo)$")


def find_java_errors(names: SymbolTable) -> Iterator[ParseProblem]:
    """Compile errors of a Java file; none for an excerpt, which has no package."""
    module = names.main
    if not module.package:
        return
    yield from _imports(names)
    yield from _replaced(names)
    yield from find_type_errors(names)
    yield from _file_name(names)
    yield from _constructors(names)
    yield from _never_set(names)
    every = list(walk_with_scopes(module.body, Scope(module)))
    yield from _inheritance(every, names)
    yield from _runs_of_v3(every, names)
    season = find_season(module.imports)
    if season == OLD_SEASON:
        yield from _names_of_2027(every, names)
    elif season:
        yield from _names_before_2027(every, names)
    open_ = any(one.name == "*" and not _static(one) for one in module.imports)
    declared = {node.name for node, _ in every if isinstance(node, Class)}
    defined = frozenset(node.name for node, _ in every if isinstance(node, Function))
    targets = {node.target for node, _ in every if isinstance(node, Call)}
    made = [one for one, _ in every if isinstance(one, Assign) and one.declares]
    brought = {get_last_name(one.target) for one in made}
    brought |= {one.name for one, _ in every if isinstance(one, FunctionParameter)}
    for node, scope in every:
        line = node.place.line
        target = node.target if isinstance(node, Assign) and not node.declares else None
        if isinstance(target, Name) and target.name not in brought and _closed(scope, names):
            yield ParseProblem(f"{target.name} is not declared", line)
        for name in _types(node):
            if not open_ and not _is_type(name, declared, scope, names):
                yield _undeclared(name, scope, line)
        method = node in targets and not getattr(node, "name", "")[:1].isupper()
        if isinstance(node, Name) and is_value_name(node) and not method:
            yield from _variable(node, declared, scope, names, open_=open_)
        elif isinstance(node, Call):
            yield from _method(node, scope, names, defined)


def _names_of_2027(every: list[tuple[Node, Scope]], names: SymbolTable) -> Iterator[ParseProblem]:
    """Names that came with WPILib 2027, in a program that imports the packages before it."""
    for node, scope in every:
        if not isinstance(node, Member):
            continue
        of_mode = node.name in MODES_OF_2027 and get_last_name(node.owner) in MODES_OF
        of_motor = node.name in MOTORS_OF_2027 and is_motor(infer_type(node.owner, scope, names))
        if of_mode or of_motor:
            old = (MODES_OF_2027 | MOTORS_OF_2027)[node.name]
            said = f"{node.name} is a name of WPILib 2027, and your imports are older"
            yield ParseProblem(f"{said}. Did you mean {old}?", node.place.line, old)


def _names_before_2027(
    every: list[tuple[Node, Scope]], names: SymbolTable
) -> Iterator[ParseProblem]:
    """Names that WPILib 2027 no longer has, in a program that imports its packages."""
    of_motor = {old: new for new, old in MOTORS_OF_2027.items()}
    of_direction = {old: new for new, old in DIRECTIONS_OF_2027.items()}
    for node, scope in every:
        if isinstance(node, Call) and isinstance(dict(enumerate(node.args)).get(1), Text):
            made = find_constructed_class(node, scope, names)
            if made in CAN_DEVICES:
                # Phoenix 6, 25.90.0-alpha-2: the constructor that takes the bus as text is removed.
                said = f"for WPILib 2027, {made} takes a CANBus, and no text: new CANBus(...)"
                yield ParseProblem(said, node.place.line)
        if not isinstance(node, Member):
            continue
        new = ""
        if node.name in of_motor:
            type_ = get_simple_type_name(infer_type(node.owner, scope, names))
            if type_ in PWM_MOTORS and names.find_by_name(type_, scope) is None:
                new = of_motor[node.name]
        elif get_last_name(node.owner) == "Direction":
            new = of_direction.get(node.name, "")
        if new:
            said = f"WPILib 2027 has no {node.name} here. Did you mean {new}?"
            yield ParseProblem(said, node.place.line, new)


def _file_name(names: SymbolTable) -> Iterator[ParseProblem]:
    """A public class whose name is nearly its file's: Java wants both to be the same."""
    stem = names.main.path.stem
    for node in names.main.body:
        public = isinstance(node, Class) and node.place.text.startswith("public")
        if public and isinstance(node, Class) and suggest_name(node.name, frozenset({stem})):
            said = f"the class is called {node.name}, and its file {stem}: give both the same name"
            yield ParseProblem(said, node.place.line)


def _runs_of_v3(every: list[tuple[Node, Scope]], names: SymbolTable) -> Iterator[ParseProblem]:
    """``run`` of a Mechanism of Commands v3 with a lambda that takes no coroutine."""
    if not any(one.path.startswith(COMMANDS_V3) for one in names.main.imports):
        return
    for node, scope in every:
        if not isinstance(node, Call) or get_last_name(node.target) != "run" or len(node.args) != 1:
            continue
        owner = node.target.owner if isinstance(node.target, Member) else Self(node.place)
        given = node.args[0]
        own = bool(find_called_functions(node, scope, names)) or not isinstance(owner, Self)
        if not own and isinstance(given, Function) and not given.parameters:
            said = "run() of a Mechanism takes a coroutine: run(coroutine -> ...), or runRepeatedly"
            yield ParseProblem(said, node.place.line)


def _inheritance(every: list[tuple[Node, Scope]], names: SymbolTable) -> Iterator[ParseProblem]:
    """Classes of the command library that are implemented, and its interfaces that are extended."""
    for node, scope in every:
        if not isinstance(node, Class):
            continue
        head = node.place.text.partition("{")[0]
        extended, _, implemented = head.partition("implements")
        for word, kinds, instead in (
            (implemented, SUBSYSTEM_CLASSES, "extends"),
            (extended.partition("extends")[2], SUBSYSTEM_INTERFACES, "implements"),
        ):
            for base in re.findall(r"\w+", re.sub(r"<.*>", "", word)):
                brought = any(
                    one.name == base and one.path.startswith(LIBRARIES)
                    for one in scope.module.imports
                )
                if base in kinds and brought and names.find_by_name(base, scope) is None:
                    kind = "a class" if instead == "extends" else "an interface"
                    said = f"{base} is {kind}: write {instead} {base}"
                    yield ParseProblem(said, node.place.line)


def _constructors(names: SymbolTable) -> Iterator[ParseProblem]:
    """What looks like a constructor, and is called unlike every class here."""
    source = names.main.source.decode("utf-8", errors="replace")
    classes = set(re.findall(r"\b(?:class|enum|record|interface)\s+(\w+)", source))
    for found in CONSTRUCTOR.finditer(source):
        if found["name"] not in classes:
            line = source.count("\n", 0, found.start("name")) + 1
            said = f"{found['name']}() has no return type, and no class has this name"
            yield ParseProblem(said, line)


def _never_set(names: SymbolTable) -> Iterator[ParseProblem]:
    """Final fields that get no value."""
    source = names.main.source.decode("utf-8", errors="replace")
    for found in BLANK_FINAL.finditer(source):
        name = found["name"]
        if not re.search(rf"\b{name}\s*=(?!=)", source):
            line = source.count("\n", 0, found.start("name")) + 1
            yield ParseProblem(f"{name} is final and never gets a value", line)


def is_value_name(node: Name) -> bool:
    """Whether a name can be a variable, a constant or a class."""
    return node.name not in {"super", "this", "_", "length"} and node.name.isidentifier()


def _static(one: Import) -> bool:
    """Whether an import brings in members of a class: ``Units.*``."""
    return one.path.rpartition(".")[2][:1].isupper()


def _imports(names: SymbolTable) -> Iterator[ParseProblem]:
    source = names.main.source.decode("utf-8", errors="replace").split("\n")
    for one in names.main.imports:
        line = next((at for at, text in enumerate(source, 1) if _imports_it(text, one)), 1)
        owner, _, name = one.path.rpartition(".")
        if owner.rpartition(".")[2] == "Units" and name[:1].isupper() and "units" in owner:
            meant = suggest_name(name, frozenset(UNITS))
            if name not in UNITS and meant:
                yield make_spelling_problem("unit", name, meant=meant, line=line)
            continue
        if one.name == "*" or not one.path.startswith(SEASON):
            continue
        meant = suggest_name(name, HOME)
        if meant:
            yield make_spelling_problem("class", name, meant=meant, line=line)
        elif name in HOME and not HOME[name].startswith(owner):
            yield ParseProblem(f"{name} is not in {owner}: it is in {HOME[name]}", line)


def _replaced(names: SymbolTable) -> Iterator[ParseProblem]:
    """Classes and units of WPILib and of vendors that are replaced by code that is not here."""
    text = names.main.source.decode("utf-8", errors="replace")
    team = names.main.package.partition(".")[0]
    for one in names.main.imports:
        name = one.path.rpartition(".")[2]
        known = name in HOME or name in UNITS or is_motor(name)
        if (
            known
            and one.path.startswith(f"{team}.")
            and not one.path.startswith(LIBRARIES)
            and names.find_by_name(name, Scope(names.main)) is None
        ):
            lines = enumerate(text.split("\n"), 1)
            line = next((at for at, row in lines if _imports_it(row, one)), 1)
            yield ParseProblem(f"{one.path} is not the {name} of WPILib or of its vendor", line)
    for found in OWN_BODY.finditer(text):
        if is_motor(found["type"]):
            line = text.count("\n", 0, found.start()) + 1
            said = f"this {found['type']} has methods of its own. Make it without them"
            yield ParseProblem(said, line)


def _imports_it(text: str, one: Import) -> bool:
    path = one.path if one.name != "*" else f"{one.path}.*"
    return bool(re.match(rf"\s*import\s+(static\s+)?{re.escape(path)}\s*;", text))


def _types(node: Node) -> Iterator[str]:
    """The classes that a declaration names, without those that stand behind a dot."""
    written = ""
    if isinstance(node, Assign | FunctionParameter | Function | Cast):
        written = node.type
    elif isinstance(node, Class):
        written = " ".join(base for base in node.bases if base[:1].isupper())
    yield from re.findall(r"(?<![\w.])[A-Z]\w+", written)


def _is_type(name: str, declared: set[str], scope: Scope, names: SymbolTable) -> bool:
    if name in declared or name in LANG or any(one.name == name for one in scope.module.imports):
        return True
    if name.endswith(GENERATED):
        return True
    source = scope.module.source.decode("utf-8", errors="replace")
    if re.search(rf"(?<=\.){name}\b", source) and any(
        one.name == "*" or one.name[:1].isupper() for one in scope.module.imports
    ):
        inherited = re.search(rf"[A-Z]\w*\.{name}\b", source)
        if inherited and not scope.classes:
            return True
    return names.find_by_name(name, scope) is not None


def _undeclared(name: str, scope: Scope, line: int) -> ParseProblem:
    # WPILib 2027 moved its classes: the packages that HOME knows are those before it.
    moved = find_season(scope.module.imports) > OLD_SEASON
    if moved and HOME.get(name, "").startswith("edu.wpi."):
        return ParseProblem(f"{name} is not imported", line)
    if name in HOME:
        return ParseProblem(f"{name} is not imported: import {HOME[name]}.{name};", line)
    meant = suggest_name(name, HOME)
    if meant:
        return make_spelling_problem("class", name, meant=meant, line=line)
    return ParseProblem(f"{name} is not imported", line)


def _variable(
    node: Name, declared: set[str], scope: Scope, names: SymbolTable, *, open_: bool
) -> Iterator[ParseProblem]:
    name = node.name
    if names.find_local(name, scope) or names.find_definitions(node, scope) or PACKAGE.match(name):
        return
    imported = any(one.name == name for one in scope.module.imports)
    if imported or name in declared or _is_field(name, scope, names) or _is_case(node):
        return
    wide = any(one.name == "*" and _static(one) for one in scope.module.imports)
    if name in UNITS:
        if not wide:
            yield ParseProblem(f"the unit {name} is not imported", node.place.line)
    elif name[:1].isupper() and not re.fullmatch(r"[A-Z][A-Z0-9_]*", name):
        if not open_ and not _is_type(name, declared, scope, names):
            yield _undeclared(name, scope, node.place.line)
    elif not wide and _closed(scope, names) and _is_plain(node, scope):
        yield ParseProblem(f"{name} is not declared", node.place.line)


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


def _is_field(name: str, scope: Scope, names: SymbolTable) -> bool:
    for count in range(len(scope.classes), 0, -1):
        home = Scope(scope.module, scope.classes[:count])
        if any(name in names.find_fields(place) for place in names.list_base_classes(home)):
            return True
        body = home.classes[-1].place.text if count else ""
        if "enum" in body:
            return True
    return False


def _closed(scope: Scope, names: SymbolTable) -> bool:
    """Whether all that the classes around inherit is known."""
    for count in range(len(scope.classes), 0, -1):
        for place in names.list_base_classes(Scope(scope.module, scope.classes[:count])):
            for base in place.classes[-1].bases:
                if (
                    get_simple_type_name(base) not in PLAIN
                    and names.find_by_name(get_simple_type_name(base), place) is None
                ):
                    return False
    return True


def _method(
    call: Call, scope: Scope, names: SymbolTable, defined: frozenset[str]
) -> Iterator[ParseProblem]:
    """What a compiler says of a call; ``defined`` are the methods of all classes of the file."""
    target = call.target
    line = target.place.line
    if isinstance(target, Member) and not isinstance(target, Reference):
        made = target.name[:1].isupper() and names.find_home(target, scope)  # new Outer.Inner()
        if find_called_functions(call, scope, names) or isinstance(target.owner, Self) or made:
            return
        home = find_class(target.owner, scope, names)
        if home is not None and home.classes and _closed(home, names):
            there = find_methods(target.name, home, names) or target.name in INHERITED
            record = home.classes[-1].place.text.split("{")[0]
            if not there and "enum" not in record and "record" not in record:
                yield _missing_method(target, home, names)
            return
        if target.name in defined:
            return
        meant = suggest_name(target.name, METHODS)
        if meant and target.name[:1].islower():
            yield make_spelling_problem("method", target.name, meant=meant, line=line)
    elif isinstance(target, Name) and target.name[:1].islower():
        static = any(
            one.name == target.name or (one.name == "*" and _static(one))
            for one in scope.module.imports
        )
        if (
            find_called_functions(call, scope, names)
            or target.name in INHERITED
            or target.name in defined
        ):
            return
        if not static and _closed(scope, names) and scope.classes:
            yield ParseProblem(f"the method {target.name}() is not declared", line)


def _missing_method(target: Member, home: Scope, names: SymbolTable) -> ParseProblem:
    """A method that a class in sight does not have."""
    line = target.place.line
    meant = suggest_name(target.name, _own_methods(home, names) | METHODS)
    if meant:
        return make_spelling_problem("method", target.name, meant=meant, line=line)
    return ParseProblem(f"{home.classes[-1].name} has no method {target.name}()", line)


def _own_methods(home: Scope, names: SymbolTable) -> frozenset[str]:
    """The names of the methods that a class defines or inherits from classes in sight."""
    return frozenset(
        node.name
        for place in names.list_base_classes(home)
        for node in place.classes[-1].body
        if isinstance(node, Function)
    )
