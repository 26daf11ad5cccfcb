"""What a name stands for: locals, fields, constants of other classes and of other files.

By the languages' own rules where text can tell, and otherwise not at all.
"""

from collections.abc import Iterator
from itertools import chain

from grader.robotcode.files import Files
from grader.robotcode.scope import Definition, Definitions, Scope, bindings, walk
from grader.robotcode.syntax import (
    Assign,
    Class,
    Function,
    Member,
    Module,
    Name,
    Node,
    Self,
    inside,
)

DEEPEST = 5  # classes above a class, files behind an import
LONGEST = 12  # names in a row: org.wpilib.robot.Constants.Drive.kRamp has six


class Names:
    """The names of one program.

    Args:
        files: the file in hand and its neighbors.
    """

    def __init__(self, files: Files) -> None:
        self.main = files.main
        self._files = files
        self._bound: dict[Function | Module, dict[str, Definitions]] = {}
        self._fields: dict[Class, dict[str, Definitions]] = {}
        self._bases: dict[Class, tuple[Scope, ...]] = {}

    def definitions(self, node: Node, scope: Scope) -> Definitions:
        """Every place where a variable gets its value; none if it is not in these files."""
        if isinstance(node, Name):
            return self._variable(node.name, scope)
        if isinstance(node, Member):
            home = self.home(node.owner, scope)
            return () if home is None else self._in_home(node.name, home, depth=0)
        return ()

    def local(self, name: str, scope: Scope) -> Definitions:
        """Where a variable of the functions around gets its value; none if it is not one."""
        for count in range(len(scope.functions), 0, -1):
            inner = Scope(scope.module, scope.classes, scope.functions[:count])
            found = self._locals(inner).get(name)
            if found:
                return found
        return ()

    def field_name(self, node: Node, scope: Scope) -> str:
        """The name of the field of this object that a node is; empty if it is none."""
        if isinstance(node, Member) and isinstance(node.owner, Self):
            return node.name
        if isinstance(node, Name) and scope.module.language == "java" and scope.classes:
            return "" if self.local(node.name, scope) else node.name
        return ""

    def fields(self, home: Scope) -> dict[str, Definitions]:
        """The fields of a class, by every value they get anywhere in it."""
        owner = home.classes[-1]
        if owner not in self._fields:
            found = {name: list(several) for name, several in bindings(owner.body, home).items()}
            for name, definition in self._set_in_methods(home):
                found.setdefault(name, []).append(definition)
            self._fields[owner] = {name: tuple(several) for name, several in found.items()}
        return self._fields[owner]

    def bases(self, home: Scope) -> tuple[Scope, ...]:
        """The classes that a class extends, as far as these files hold them."""
        owner = home.classes[-1]
        if owner not in self._bases:
            self._bases[owner] = ()  # a class that extends itself in a circle extends nothing
            around = Scope(home.module, home.classes[:-1])
            found = (self.named(base, around) for base in owner.bases)
            self._bases[owner] = tuple(
                base for base in found if base and base.classes and base.classes[-1] is not owner
            )
        return self._bases[owner]

    def home(self, node: Node, scope: Scope) -> Scope | None:
        """The class or file a node names: ``this``, ``Constants.Drive``, ``constants``."""
        path: list[str] = []
        while isinstance(node, Member) and len(path) < LONGEST:
            path.insert(0, node.name)
            node = node.owner
        if isinstance(node, Self):
            return self._descend(path, scope.home if scope.classes else None, depth=0)
        if not isinstance(node, Name) or self.local(node.name, scope):
            return None
        start = self.named(node.name, scope)
        if start is None and scope.module.language == "java":  # a name with its package in front
            return self._found(".".join((node.name, *path)), scope.module, level=0, depth=0)
        return self._descend(path, start, depth=0)

    def named(self, name: str, scope: Scope) -> Scope | None:
        """The class or file of a bare name, as seen from a scope."""
        for count in range(len(scope.classes), 0, -1):
            around = Scope(scope.module, scope.classes[:count])
            if around.classes[-1].name == name:
                return around
            found = self._nested(name, around, depth=0)
            if found is not None:
                return found
        found = self._nested(name, Scope(scope.module), depth=0)
        if found is None and scope.module.language == "java":
            return self._found(name, scope.module, level=0, depth=0)
        return found

    def _variable(self, name: str, scope: Scope) -> Definitions:
        found = self.local(name, scope)
        homes = [Scope(scope.module)]
        if scope.module.language == "java":  # a Python method sees no field without self
            homes = [
                Scope(scope.module, scope.classes[:n]) for n in range(len(scope.classes), -1, -1)
            ]
        return found or _first(self._in_home(name, home, depth=0) for home in homes)

    def _locals(self, scope: Scope) -> dict[str, Definitions]:
        """The variables of the innermost function, its parameters among them."""
        function = scope.functions[-1]
        if function not in self._bound:
            found = bindings(function.body, scope)
            for parameter in function.parameters:
                given = Definition(parameter, scope, parameter.type)
                found[parameter.name] = (given, *found.get(parameter.name, ()))
            self._bound[function] = found
        return self._bound[function]

    def _in_home(self, name: str, home: Scope, *, depth: int) -> Definitions:
        """A field of a class or of those above it, or a name at the top of a file."""
        if depth > DEEPEST:
            return ()
        if home.classes:
            above = (self._in_home(name, base, depth=depth + 1) for base in self.bases(home))
            return _first(chain([self.fields(home).get(name, ())], above))
        module = home.module
        if module not in self._bound:
            self._bound[module] = bindings(module.body, home)
        owners = (
            (path, self._found(path.rpartition(".")[0], module, level=level, depth=depth + 1))
            for path, level in _imports_of(name, module)
        )
        brought = (
            self._in_home(path.rpartition(".")[2], owner, depth=depth + 1)
            for path, owner in owners
            if owner is not None and owner.module is not module
        )
        return _first(chain([self._bound[module].get(name, ())], brought))

    def _set_in_methods(self, home: Scope) -> Iterator[tuple[str, Definition]]:
        members = inside(*home.classes[-1].body, but=(Function, Class))
        methods = tuple(node for node in members if isinstance(node, Function))
        for node, scope in walk(methods, home):
            if isinstance(node, Assign) and not node.declares and scope.classes == home.classes:
                name = self.field_name(node.target, scope)
                if name:
                    yield name, Definition(node.value, scope, node.type)

    def _nested(self, name: str, home: Scope, *, depth: int) -> Scope | None:
        """A class in a class or file, in a class above it, or brought into the file."""
        if depth > DEEPEST:
            return None
        body = home.classes[-1].body if home.classes else home.module.body
        for node in inside(*body, but=(Function, Class)):
            if isinstance(node, Class) and node.name == name:
                return Scope(home.module, (*home.classes, node))
        if home.classes:
            above = (self._nested(name, base, depth=depth + 1) for base in self.bases(home))
            return next(filter(None, above), None)
        brought = (
            self._found(path, home.module, level=level, depth=depth + 1)
            for path, level in _imports_of(name, home.module)
        )
        return next(filter(None, brought), None)

    def _found(self, path: str, module: Module, *, level: int, depth: int) -> Scope | None:
        """The class or file of a dotted name in another file."""
        found = self._files.find(path, level=level, seen_from=module)
        if found is None or (found[0] is module and not found[1]):
            return None
        rest = list(found[1])
        return self._descend(rest, Scope(found[0]), depth=depth + 1)

    def _descend(self, path: list[str], home: Scope | None, *, depth: int) -> Scope | None:
        for name in path:
            home = None if home is None else self._nested(name, home, depth=depth)
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
