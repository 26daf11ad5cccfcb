"""Java classes as Python classes: fields, methods with their overloads, constructors, their order.

A Java class is compiled to a Python class, so that fakes see what a learner overrides. Instances
keep their Java fields in ``__dict__`` under names that begin with a point.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

from tree_sitter import Node

from grader.robotcode.java import runtime, streams, type_names, values
from grader.robotcode.java.scope import (
    Env,
    Frame,
    child,
    kind_of,
    named,
    text,
)
from grader.robotcode.java.syntax import At
from grader.robotcode.java.values import BOXES, PRIMITIVES, NullPointerException, Throwable
from grader.robotcode.library.base import Unknown, WrongArgument

if TYPE_CHECKING:
    from grader.robotcode.java.program import Unit
    from grader.robotcode.java.scope import Field, Run

NUMBERS = ("byte", "short", "int", "long", "float", "double")  # each widens to those after it
WIDENS = {one: frozenset(NUMBERS[at + 1 :]) for at, one in enumerate(NUMBERS)}
WIDENS["char"] = frozenset(NUMBERS[2:])
BOXING, ANYTHING = 50.0, 20.0  # what it costs an overload to box, or to take just any object
DECLARATIONS = {
    "class_declaration": "class",
    "interface_declaration": "interface",
    "enum_declaration": "enum",
    "record_declaration": "record",
    "annotation_type_declaration": "annotation",
}


class JavaObject:
    """Base of the classes that a program declares and that extend nothing else."""

    def __call__(self, *args: Any) -> Any:
        """Call it as the functional interface that it implements."""
        for name in streams.FUNCTIONAL:
            if runtime.find_attribute(type(self), name) is not None:
                return getattr(self, runtime.python_name(name))(*args)
        raise WrongArgument(f"a {type(self).__name__} is not a function")

    def __eq__(self, other: object) -> bool:
        return values.equals(self, other)

    def __hash__(self) -> int:
        return values.hash_code(self)


@dataclass
class Method:
    """A method or constructor.

    Args:
        names, kinds: its parameters.
        varargs: whether the last one takes any number of values.
        make: compiles ``run``.
    """

    owner: "JavaClass"
    name: str
    names: list[str]
    kinds: list[str]
    varargs: bool
    modifiers: frozenset[str]
    returns: str
    at: At
    node: Node
    make: Callable[[], Callable[..., Any]] = field(default=lambda: lambda *_: None)
    abstract: bool = False

    @cached_property
    def run(self) -> Callable[..., Any]:
        """What takes ``this`` and the values, as many as there are parameters."""
        return self.make()

    @cached_property
    def static(self) -> bool:
        """Whether it has no ``this``."""
        return "static" in self.modifiers

    @cached_property
    def exact(self) -> list[type | None]:
        """The types whose values a parameter takes unchanged; None if values must be checked."""
        return [values.TYPES.get(one) for one in self.kinds]

    def compute_cost(self, args: Sequence[Any], kinds: Sequence[str], *, spread: bool) -> float:
        """The cost of converting the arguments to the parameters; infinite if they do not fit."""
        wanted = list(self.kinds)
        if spread:
            if not self.varargs or len(args) < len(wanted) - 1:
                return math.inf
            last = wanted.pop().removesuffix("[]")
            wanted += [last] * (len(args) - len(wanted))
        if len(wanted) != len(args):
            return math.inf
        told = [*kinds, *[""] * len(args)]
        return sum(
            self.owner.compute_conversion_cost(k, a, t)
            for k, a, t in zip(wanted, args, told, strict=False)
        )

    def bind(self, args: Sequence[Any], *, spread: bool) -> list[Any]:
        """The arguments as the parameters hold them."""
        given = list(args)
        if spread:
            fixed = len(self.kinds) - 1
            kind = self.kinds[-1].removesuffix("[]")
            rest = [self.owner.convert(kind, one) for one in given[fixed:]]
            given = [*given[:fixed], values.Array(rest, kind)]
        convert = self.owner.convert
        return [
            one if type(one) is exact else convert(kind, one)
            for kind, exact, one in zip(self.kinds, self.exact, given, strict=True)
        ]


class Overloads:
    """All methods of one name in a class and above it.

    Args:
        name: the name.
        methods: those of Java, the nearest class first.
        inherited: a library's method of this name, or None.
    """

    def __init__(self, name: str, methods: list[Method], inherited: Any) -> None:
        self.name, self.methods, self.inherited = name, methods, inherited
        alone = len(methods) == 1 and inherited is None and not methods[0].varargs
        self.only = methods[0] if alone else None

    @property
    def abstract(self) -> bool:
        """Whether none of them has a body."""
        return all(one.abstract for one in self.methods)

    def choose(self, args: Sequence[Any], kinds: Sequence[str]) -> tuple[Method | None, bool]:
        """The overload that takes some arguments, and whether its last parameter collects them."""
        if self.only is not None and len(args) == len(self.only.kinds):
            return self.only, False
        for spread in (False, True):
            costs = [one.compute_cost(args, kinds, spread=spread) for one in self.methods]
            best = min(costs)
            if best < math.inf:
                return self.methods[costs.index(best)], spread
        return None, False

    def call(self, this: Any, args: Sequence[Any], kinds: Sequence[str]) -> Any:
        """Call the one that fits.

        Raises:
            WrongArgument: none does.
        """
        if not args and self.only is not None and not self.only.kinds:
            return self.only.run(this)
        method, spread = self.choose(args, kinds)
        if method is None:
            if self.inherited is not None:
                return self.inherited(this, *args)
            wanted = " or ".join(f"({', '.join(one.kinds)})" for one in self.methods)
            raise WrongArgument(f"{self.name}{wanted} does not accept these arguments")
        return method.run(this, *method.bind(args, spread=spread))


class JavaClass:
    """A class, interface, enum or record of the program.

    Args:
        name: its own name; empty of an anonymous class.
        node: its declaration, or the expression that makes an anonymous one.
        unit: the file.
        outer: the class around it.
        frame: the variables around a local or anonymous class.
    """

    def __init__(
        self,
        name: str,
        node: Node,
        unit: "Unit",
        *,
        outer: "JavaClass | None" = None,
        frame: Frame | None = None,
    ) -> None:
        self.name, self.node, self.unit, self.outer, self.frame = name, node, unit, outer, frame
        self.form = DECLARATIONS.get(node.type, "class")
        self.at = unit.source.at(node)
        self.modifiers = modifiers_of(node)
        nested = outer is not None and frame is None
        self.static = (
            outer is None
            or self.form != "class"
            or "static" in self.modifiers
            or (nested and outer.form in {"interface", "annotation"})
        ) and frame is None
        self.env_key = f"${name}{id(self)}"
        self.statics: dict[str, Any] = {}
        self.nested: dict[str, JavaClass] = {}
        self.fields: dict[str, Field] = {}
        self.methods: list[Method] = []
        self.constructors: list[Method] = []
        self.on_class: list[Run] = []  # static initializers, in order
        self.known: dict[str, Run] = {}  # what sets a constant, before anything else runs
        self.on_instance: list[Run] = []
        self.constants: list[tuple[str, Node]] = []  # of an enum
        self.components: list[tuple[str, str]] = []  # of a record: name and kind
        self.variables = self._type_parameters(node)
        self.state = "new"
        self.parent: Any = None  # a JavaClass, a library's class, or None
        self.interfaces: list[Any] = []
        self.members = self._find_body()
        for member in self.members:
            if member.type in DECLARATIONS:
                inner = text(member.child_by_field_name("name"))
                self.nested[inner] = JavaClass(inner, member, unit, outer=self)

    def _find_body(self) -> list[Node]:
        body = self.node.child_by_field_name("body") or child(self.node, "class_body")
        if body is None:
            return []
        found = list(named(body))
        for part in [one for one in found if one.type == "enum_body_declarations"]:
            found.remove(part)
            found += list(named(part))
        return found

    @staticmethod
    def _type_parameters(node: Node) -> set[str]:
        found = child(node, "type_parameters")
        return {text(next(named(one))) for one in named(found)} if found is not None else set()

    @property
    def full_name(self) -> str:
        """The name of the class with those of its outer classes, as Java's getName returns it."""
        if self.outer is not None:
            return f"{self.outer.full_name}${self.name}"
        return f"{self.unit.package}.{self.name}".lstrip(".")

    @cached_property
    def cls(self) -> type:
        """The Python class; making it compiles the members of the Java class."""
        from grader.robotcode.java.members import (  # noqa: PLC0415 - they need each other
            compile_members,
            declare_members,
        )

        self.state = "making"
        self._find_parents()
        bases = [python_class(one) for one in (self.parent, *self.interfaces) if one is not None]
        bases = [one for one in bases if isinstance(one, type)]
        if self.form == "enum":
            bases.insert(0, values.JavaEnum)
        own = (one.__module__ == __name__ and not issubclass(one, Throwable) for one in bases)
        if all(own):
            bases.append(JavaObject)
        bases = [
            one for i, one in enumerate(bases)
            if not any(other is not one and issubclass(other, one) for other in bases)
            and one not in bases[:i]
        ]  # fmt: skip
        content = {"java": self, "fake_complete": False} if self.uses_lombok else {"java": self}
        made = _make_type(self.name or "Anonymous", tuple(bases), content)
        self.__dict__["cls"] = made
        self.state = "new"
        declare_members(self)
        self._install_methods()
        compile_members(self)
        return made

    @property
    def uses_lombok(self) -> bool:
        """Whether Lombok may add methods that are not in the class's text."""
        return any(one.full.startswith("lombok.") for one in self.unit.imports)

    def _find_parents(self) -> None:
        node = self.node
        if node.type == "object_creation_expression":
            base = self.resolve_node(node.child_by_field_name("type"))
            if isinstance(base, JavaClass) and base.form == "interface":
                self.interfaces = [base]
            else:
                self.parent = base
            return
        above = node.child_by_field_name("superclass")
        if above is not None:
            self.parent = self.resolve_node(next(named(above)))
        for part in (child(node, "super_interfaces"), child(node, "extends_interfaces")):
            for one in named(next(named(part))) if part is not None else ():
                self.interfaces.append(self.resolve_node(one))
        for one in (self.parent, *self.interfaces):
            if isinstance(one, JavaClass) and one.state == "making" and "cls" not in vars(one):
                self.unit.program.error(f"cyclic inheritance: {one.name} is above itself", self.at)
                self.parent, self.interfaces = None, []

    def resolve_node(self, node: Node | None) -> Any:
        """The class that a type names; None if it is unknown, which is recorded as an error."""
        return self.unit.program.resolve_or_report(kind_of(node), self, self.unit.source.at(node))

    def _install_methods(self) -> None:
        """Add the methods to the Python class, with inherited ones of the same name."""
        by_name: dict[str, list[Method]] = {}
        for one in self.methods:
            by_name.setdefault(one.name, []).append(one)
        for name, mine in by_name.items():
            attribute = runtime.python_name(name)
            above, inherited = list(mine), None
            for base in self.cls.__mro__[1:]:
                found = base.__dict__.get(attribute) if base.__module__ != "builtins" else None
                if hasattr(found, "overloads"):
                    mine_kinds = [one.kinds for one in above]
                    above += [o for o in found.overloads.methods if o.kinds not in mine_kinds]
                    inherited = inherited or found.overloads.inherited
                elif found is not None and inherited is None:
                    inherited = found.__func__ if hasattr(found, "__func__") else found
            concrete = [one for one in above if not one.abstract]
            counts = {len(one.kinds) for one in concrete}
            abstract = [one for one in above if one.abstract and len(one.kinds) not in counts]
            overloads = Overloads(name, concrete + abstract, inherited)
            setattr(
                self.cls, attribute, _make_function(overloads, static=all(m.static for m in mine))
            )

    def list_constants(self) -> list[Any]:
        """All constants of an enum, in their order."""
        self.initialize()
        return [self.statics[f".{name}"] for name, _ in self.constants]

    def ancestors(self) -> Iterator["JavaClass"]:
        """This class and the Java classes and interfaces above it, the nearest first."""
        _ = self.cls
        yield self
        for one in (self.parent, *self.interfaces):
            if isinstance(one, JavaClass):
                yield from one.ancestors()

    def find_field(self, name: str) -> "tuple[JavaClass, Field] | None":
        """A field of this class or of one above it."""
        for one in self.ancestors():
            if name in one.fields:
                return one, one.fields[name]
        return None

    def find_nested(self, name: str) -> Any:
        """A class declared in this one or in one above it; None if there is none."""
        if "cls" not in self.__dict__:
            return self.nested.get(name)
        for one in self.ancestors():
            if name in one.nested:
                return one.nested[name]
        base = self.library_base
        found = runtime.find_attribute(base, name) if base is not None else None
        return found if isinstance(found, type) else None

    @property
    def library_base(self) -> Any:
        """The nearest class above that is a library's; None if there is none."""
        one: Any = self
        while isinstance(one, JavaClass):
            _ = one.cls
            one = one.parent
        return one

    def compute_conversion_cost(self, kind: str, value: Any, static: str) -> float:
        """The cost of converting a value to a parameter; infinite if it does not fit."""
        given = static or values.KINDS.get(type(value)) or type_names.type_name(type(value))
        plain = BOXES.get(given, given)
        if isinstance(value, Unknown):
            return 1.0
        if kind in PRIMITIVES:
            boxed = BOXING if given in BOXES else 0.0
            if plain == kind:
                return boxed
            return boxed + NUMBERS.index(kind) if kind in WIDENS.get(plain, ()) else math.inf
        if kind.endswith("[]"):
            if not isinstance(value, values.Array):
                return 1.0 if value is None else math.inf
            if value.kind == kind[:-2]:
                return 0.0
            return math.inf if {value.kind, kind[:-2]} & PRIMITIVES else 1.0
        if given == kind:
            return 0.0
        if kind in BOXES:
            fits = value is None or BOXES[kind] == plain
            return BOXING if fits else math.inf
        if kind in self.variables or kind == "Object":
            return ANYTHING + (BOXING if given in PRIMITIVES else 0.0)
        if static and static not in PRIMITIVES and kind == "String":
            return math.inf if static != "null" and value is not None else 1.0
        found = self.unit.program.resolve(kind, self)
        if found is None or isinstance(found, Unknown):
            return ANYTHING
        cls = python_class(found)
        depth = len(cls.__mro__) if isinstance(cls, type) else 0
        if value is None:
            return 1.0 / (1 + depth)
        if isinstance(value, runtime.Function):
            return 2.0 if _takes_function(found) and _fits_shape(found, value) else math.inf
        if isinstance(value, cls):
            return 1.0 + len(type(value).__mro__) - depth
        if type_names.is_instance(value, kind):
            return BOXING + 1.0
        return 3.0 if callable(value) and _takes_function(found) else math.inf

    def convert(self, kind: str, value: Any) -> Any:
        """A value as a variable of a type holds it."""
        if kind in PRIMITIVES:
            if value is None:
                raise NullPointerException(f"null cannot become a {kind}")
            return values.convert(kind, value)
        if isinstance(value, runtime.Function) and value.interface is None and kind:
            found = self.unit.program.resolve(kind, self)
            if isinstance(found, JavaClass | type):
                value.interface = python_class(found)
        return value

    # -- running ----------------------------------------------------------------------------

    def initialize(self) -> dict[str, Any]:
        """The static fields; at their first use, the static initializers run, as in Java."""
        if self.state == "failed":
            raise values.ExceptionInInitializerError(self.full_name)
        if self.state != "new":
            return self.statics
        _ = self.cls
        self.state = "ready"
        if isinstance(self.parent, JavaClass):
            self.parent.initialize()
        env: Env = [None] * 2
        try:
            known = [run for name, run in self.known.items() if self.fields[name].static]
            for run in (*known, *self.on_class):
                run(env)
        except values.Throwable as problem:
            self.state = "failed"
            raise values.ExceptionInInitializerError(None, problem) from problem
        return self.statics

    def make(self, args: Sequence[Any], kinds: Sequence[str] = (), env: Env | None = None) -> Any:
        """Make an instance.

        Args:
            args: of the constructor.
            kinds: their static types.
            env: the variables around the class, where it needs them.
        """
        self.initialize()
        if "abstract" in self.modifiers or self.form in {"interface", "annotation"}:
            raise WrongArgument(f"{self.name} is abstract; no object can be made of it")
        made = self.cls.__new__(self.cls)
        self.prepare(made, env)
        self.construct(made, args, kinds)
        return made

    def prepare(self, made: Any, env: Env | None) -> None:
        """Give a new instance its fields, each with its default value: 0, false or null."""
        for one in reversed([a for a in self.ancestors() if a.form != "interface"]):
            for declared in one.fields.values():
                if not declared.static:
                    made.__dict__[declared.key] = values.default_value(declared.kind)
            if env is not None:
                made.__dict__[one.env_key] = env
            for name, run in one.known.items():
                if not one.fields[name].static:
                    run([made, None])

    def construct(self, made: Any, args: Sequence[Any], kinds: Sequence[str] = ()) -> None:
        """Run the constructor that fits, on an instance."""
        if not self.constructors:
            self.construct_parent(made, args if not self.name else (), kinds)
            self.run_initializers(made)
            return
        Overloads(f"new {self.name}", self.constructors, None).call(made, args, kinds)

    def construct_parent(self, made: Any, args: Sequence[Any], kinds: Sequence[str] = ()) -> None:
        """Run the constructor of the class above."""
        base = self.parent
        if isinstance(base, JavaClass):
            base.construct(made, args, kinds)
        elif isinstance(base, type) and base is not object:
            base.__init__(made, *args)

    def run_initializers(self, made: Any) -> None:
        """Run the initializers of fields, and the blocks among them, in the text's order."""
        env: Env = [made, None]
        for run in self.on_instance:
            run(env)


def modifiers_of(node: Node) -> frozenset[str]:
    """The modifiers of a declaration: ``private``, ``static``, ``@Override``."""
    found = child(node, "modifiers")
    return frozenset(text(one) for one in found.children) if found is not None else frozenset()


def python_class(one: Any) -> Any:
    """The Python class of a class, be it the program's or a library's."""
    return one.cls if isinstance(one, JavaClass) else one


def _takes_function(found: Any) -> bool:
    """Whether a lambda may stand for a value of this type."""
    if isinstance(found, JavaClass):
        return found.form == "interface"
    if found.__name__ in streams.FUNCTIONAL_INTERFACES:
        return True
    return any("__call__" in vars(base) for base in found.__mro__)


def _fits_shape(found: Any, function: runtime.Function) -> bool:
    """Whether a lambda takes, and gives, as many values as an interface says."""
    if isinstance(found, JavaClass):
        methods = [one for up in found.ancestors() for one in up.methods if one.abstract]
        if len(methods) != 1:
            return True
        arity, gives = len(methods[0].kinds), methods[0].returns != "void"
    elif found.__name__ in streams.FUNCTIONAL_INTERFACES:
        arity, gives = streams.shape_of(found.__name__)
    else:
        return True
    return function.arity in {-1, arity} and function.gives in {None, gives}


def _make_type(name: str, bases: tuple[type, ...], content: dict[str, Any]) -> type:
    """A Python class; where the bases contradict each other, without the later ones."""
    while True:
        try:
            kind = type(bases[0]) if bases else type
            for one in bases:
                kind = type(one) if issubclass(type(one), kind) else kind
            return kind(name, bases, dict(content))
        except TypeError:
            if len(bases) <= 1:
                raise
            bases = bases[:-1]


def _make_function(overloads: Overloads, *, static: bool) -> Any:
    """The Python function that calls a method's overloads, for fakes of library classes."""

    def call(this: Any, *args: Any) -> Any:
        return overloads.call(this, args, ())

    def call_static(*args: Any) -> Any:
        return overloads.call(None, args, ())

    made: Any = staticmethod(call_static) if static else call
    made.overloads = overloads
    return made
