"""What a name stands for: locals, fields, constants of other classes and of other files.

By the languages' own rules where text can tell, and otherwise not at all.
"""

from collections.abc import Iterator
from contextlib import contextmanager

from grader.robotcode.files import Files
from grader.robotcode.ir import (
    Assign,
    Class,
    Function,
    Member,
    Module,
    Name,
    Node,
    Self,
    iter_nodes,
)
from grader.robotcode.scope import (
    Definition,
    Definitions,
    Scope,
    collect_bindings,
    find_only_value,
    walk_with_scopes,
)

MOST_CLASSES = 12  # a class and those above it
DEEPEST = 12  # files behind files, methods behind methods, on the way to one name
LONGEST = 12  # names in a row: org.wpilib.robot.Constants.Drive.kRamp has six


class SymbolTable:
    """The names of one program.

    What is looked up is kept, and counts as not found while it is being looked up: classes that
    extend and files that import each other in a circle end there.

    Args:
        files: the file in hand and its neighbors.
    """

    def __init__(self, files: Files) -> None:
        self.main = files.main
        self.made: dict[Node, str] = {}  # by call: the class it makes
        self._files = files
        self._deep = 0
        self._members: dict[Class | Module, tuple[Function | Class, ...]] = {}
        self._bound: dict[Function | Module, dict[str, Definitions]] = {}
        self._fields: dict[Class, dict[str, Definitions]] = {}
        self._bases: dict[Class, tuple[Scope, ...]] = {}
        self._below: dict[Class, tuple[Scope, ...]] = {}
        self._tops: dict[tuple[Module, str], Definitions] = {}
        self._classes: dict[tuple[Class | Module, str], Scope | None] = {}

    @contextmanager
    def limit_depth(self) -> Iterator[bool]:
        """A context one level deeper in a search: whether the search may go on."""
        self._deep += 1
        try:
            yield self._deep <= DEEPEST
        finally:
            self._deep -= 1

    def find_definitions(self, node: Node, scope: Scope) -> Definitions:
        """Every place where a variable gets its value; none if it is not in these files."""
        if isinstance(node, Name):
            return self._variable(node.name, scope)
        if isinstance(node, Member):
            home = self.find_home(node.owner, scope)
            return () if home is None else self._in_home(node.name, home)
        return ()

    def find_local(self, name: str, scope: Scope) -> Definitions:
        """Where a variable of the functions around gets its value; none if it is not one."""
        for count in range(len(scope.functions), 0, -1):
            inner = Scope(scope.module, scope.classes, scope.functions[:count])
            found = self._locals(inner).get(name)
            if found:
                return found
        return ()

    def find_field_name(self, node: Node, scope: Scope) -> str:
        """The name of the field of this object that a node is; empty if it is none."""
        if isinstance(node, Member) and isinstance(node.owner, Self):
            return node.name
        if isinstance(node, Name) and scope.module.language == "java" and scope.classes:
            return "" if self.find_local(node.name, scope) else node.name
        return ""

    def find_fields(self, home: Scope) -> dict[str, Definitions]:
        """The fields of a class, by every value they get anywhere in it."""
        owner = home.classes[-1]
        if owner not in self._fields:
            found = {
                name: list(several) for name, several in collect_bindings(owner.body, home).items()
            }
            for name, definition in self._set_in_methods(home):
                found.setdefault(name, []).append(definition)
            self._fields[owner] = {name: tuple(several) for name, several in found.items()}
        return self._fields[owner]

    def list_base_classes(self, home: Scope) -> list[Scope]:
        """A class and those above it, as far as these files hold them."""
        found = [home]
        for place in found:
            found += [base for base in self._above(place) if base not in found]
            if len(found) >= MOST_CLASSES:
                break
        return found[:MOST_CLASSES]

    def find_implementations(self, home: Scope) -> tuple[Scope, ...]:
        """The classes of these files that directly implement or extend a class."""
        owner = home.classes[-1]
        if owner not in self._below:
            self._below[owner] = ()
            self._below[owner] = tuple(
                place
                for module in self.list_modules_with(owner.name)
                for place in self._classes_in(Scope(module))
                if owner.name in place.classes[-1].bases and home in self._above(place)
            )
        return self._below[owner]

    def list_modules_with(self, word: str) -> list[Module]:
        """The Java files of the program in whose text a word stands."""
        return self._files.find_by_word(word)

    def _classes_in(self, home: Scope) -> Iterator[Scope]:
        """The classes of a file, those inside others among them."""
        for node in self.list_members(home):
            if isinstance(node, Class):
                place = home.within(node)
                yield place
                if len(place.classes) < MOST_CLASSES:
                    yield from self._classes_in(place)

    def list_members(self, home: Scope) -> tuple[Function | Class, ...]:
        """The methods and classes directly in a class, or in a file."""
        owner: Class | Module = home.classes[-1] if home.classes else home.module
        if owner not in self._members:
            self._members[owner] = tuple(
                node
                for node in iter_nodes(*owner.body, but=(Function, Class))
                if isinstance(node, Function | Class)
            )
        return self._members[owner]

    def find_home(self, node: Node, scope: Scope) -> Scope | None:
        """The class or file a node names: ``this``, ``Constants.Drive``, ``constants``."""
        path: list[str] = []
        while isinstance(node, Member) and len(path) < LONGEST:
            path.insert(0, node.name)
            node = node.owner
        if isinstance(node, Self):
            return self._descend(path, scope.home if scope.classes else None)
        if not isinstance(node, Name):
            return None
        if self.find_local(node.name, scope):
            return self._descend(path, self._other_name(node.name, scope))
        if node.name == "super":
            return (
                next(iter(self.list_base_classes(scope.home)[1:]), None) if scope.classes else None
            )
        start = self.find_by_name(node.name, scope)
        if start is None and scope.module.language == "java":  # a name with its package in front
            return self._found(".".join((node.name, *path)), scope.module)
        return self._descend(path, start or self._other_name(node.name, scope))

    def _other_name(self, name: str, scope: Scope) -> Scope | None:
        """The class that a variable of Python is another name for: ``C = constants.Drive``."""
        only = find_only_value(self._variable(name, scope))
        if scope.module.language == "java" or only is None:
            return None
        if not isinstance(only[0], Name | Member) or not only[0].name[:1].isupper():
            return None
        with self.limit_depth() as allowed:
            return self.find_home(*only) if allowed else None

    def find_by_name(self, name: str, scope: Scope) -> Scope | None:
        """The class or file of a bare name, as seen from a scope."""
        for around in scope.homes:
            found = around if around.classes[-1].name == name else self._nested(name, around)
            if found is not None:
                return found
        found = self._nested(name, Scope(scope.module))
        if found is None and scope.module.language == "java":
            return self._found(name, scope.module)
        return found

    def _above(self, home: Scope) -> tuple[Scope, ...]:
        owner = home.classes[-1]
        if owner not in self._bases:
            self._bases[owner] = ()
            around = Scope(home.module, home.classes[:-1])
            found = (self.find_by_name(base, around) for base in owner.bases[:MOST_CLASSES])
            self._bases[owner] = tuple(base for base in found if base and base.classes)
        return self._bases[owner]

    def _variable(self, name: str, scope: Scope) -> Definitions:
        found = self.find_local(name, scope)
        least = 0
        if scope.module.language == "python":  # a method sees no field without self, a class does
            least = len(scope.classes) - (not scope.functions)
        for count in range(len(scope.classes), least, -1):
            found = found or self._in_home(name, Scope(scope.module, scope.classes[:count]))
        return found or self._in_home(name, Scope(scope.module))

    def _locals(self, scope: Scope) -> dict[str, Definitions]:
        """The variables of the innermost function, its parameters among them."""
        function = scope.functions[-1]
        if function not in self._bound:
            found = collect_bindings(function.body, scope)
            for parameter in function.parameters:
                given = Definition(parameter, scope, parameter.type)
                found[parameter.name] = (given, *found.get(parameter.name, ()))
            self._bound[function] = found
        return self._bound[function]

    def _in_home(self, name: str, home: Scope) -> Definitions:
        """A field of a class or of those above it, or a name at the top of a file."""
        if home.classes:
            return _first(
                self.find_fields(place).get(name, ()) for place in self.list_base_classes(home)
            )
        module = home.module
        if module not in self._bound:
            self._bound[module] = collect_bindings(module.body, home)
        if (module, name) not in self._tops:
            self._tops[module, name] = ()
            here = self._bound[module].get(name, ())
            self._tops[module, name] = here or _first(self._brought(name, module))
        return self._tops[module, name]

    def _brought(self, name: str, module: Module) -> Iterator[Definitions]:
        """A constant that an import brings into a file."""
        for path, level in _imports_of(name, module):
            owner = self._found(path.rpartition(".")[0], module, level=level)
            if owner is None or owner.module is module:
                continue
            with self.limit_depth() as allowed:
                found = self._in_home(path.rpartition(".")[2], owner) if allowed else ()
            yield found

    def _set_in_methods(self, home: Scope) -> Iterator[tuple[str, Definition]]:
        methods = tuple(node for node in self.list_members(home) if isinstance(node, Function))
        for node, scope in walk_with_scopes(methods, home):
            if isinstance(node, Assign) and not node.declares and scope.classes == home.classes:
                name = self.find_field_name(node.target, scope)
                if name:
                    yield name, Definition(node.value, scope, node.type)

    def _nested(self, name: str, home: Scope) -> Scope | None:
        """A class in a class or file, in a class above it, or brought into the file."""
        key = (home.classes[-1] if home.classes else home.module, name)
        if key not in self._classes:
            self._classes[key] = None
            places = self.list_base_classes(home) if home.classes else [home]
            here = next(filter(None, (self._class_in(place, name) for place in places)), None)
            paths = () if home.classes or here else _imports_of(name, home.module)
            brought = (self._found(path, home.module, level=level) for path, level in paths)
            self._classes[key] = here or next(filter(None, brought), None)
        return self._classes[key]

    def _class_in(self, home: Scope, name: str) -> Scope | None:
        for node in self.list_members(home):
            if isinstance(node, Class) and node.name == name:
                return Scope(home.module, (*home.classes, node))
        return None

    def _found(self, path: str, module: Module, *, level: int = 0) -> Scope | None:
        """The class or file of a dotted name in another file."""
        found = self._files.find(path, level=level, seen_from=module)
        if found is None or (found[0] is module and not found[1]):
            return None
        with self.limit_depth() as allowed:
            return self._descend(list(found[1]), Scope(found[0])) if allowed else None

    def _descend(self, path: list[str], home: Scope | None) -> Scope | None:
        for name in path:
            home = None if home is None else self._nested(name, home)
        return home


def _first(several: Iterator[Definitions]) -> Definitions:
    return next(filter(None, several), ())


def _imports_of(name: str, module: Module) -> Iterator[tuple[str, int]]:
    """The dotted names, and their leading dots, that a name may have come from."""
    for one in module.imports:
        if one.name == name:
            yield one.path, one.level
        elif one.name == "*":
            yield f"{one.path}.{name}".lstrip("."), one.level
