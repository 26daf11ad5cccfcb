"""Java expressions, compiled to Python functions of the local variables."""

import difflib
import functools
import inspect
import types
from collections.abc import Callable, Iterator, Sequence
from enum import Enum
from typing import Any

from tree_sitter import Node

from grader.robotcode.java import runtime, type_names, values
from grader.robotcode.java.classes import JavaClass, python_class
from grader.robotcode.java.literals import read_number, read_string
from grader.robotcode.java.program import packages_of
from grader.robotcode.java.runtime import STATE, Function
from grader.robotcode.java.scope import (
    RESULT,
    THIS,
    Arguments,
    Code,
    Env,
    Field,
    Frame,
    Local,
    Place,
    Run,
    child,
    kind_of,
    named,
    text,
)
from grader.robotcode.java.static_types import (
    KINDS,
    StaticTypes,
    has_known_members,
    join_codes,
    member_names,
    promoted,
    unknown_name,
)
from grader.robotcode.java.syntax import At
from grader.robotcode.java.values import BOXES, PRIMITIVES, Array
from grader.robotcode.library.base import Fake, NoSuchMember, Unknown, WrongArgument

NEARLY = 0.84  # how much of two names has to agree, from 0 to 1
UNITS, UNITS_2027 = "edu.wpi.first.units.Units", "org.wpilib.units.Units"
LONGEST_TEXT = 60  # [characters] of code that is cited
OPERATORS: dict[str, Callable[..., Any]] = {
    "+": values.add,
    "-": values.subtract,
    "*": values.multiply,
    "/": values.divide,
    "%": values.remainder,
    "&": values.bit_and,
    "|": values.bit_or,
    "^": values.bit_xor,
    "<": values.less,
    "<=": values.less_equal,
    ">": values.greater,
    ">=": values.greater_equal,
    "==": values.same,
    "!=": values.differ,
}
COMPARISONS = frozenset({"<", "<=", ">", ">=", "==", "!="})


class ExpressionCompiler(StaticTypes):
    """Compiles the expressions of one method, lambda or initializer.

    Args:
        owner: the class that it belongs to.
        frame: its local variables.
    """

    def __init__(self, owner: JavaClass, frame: Frame) -> None:
        super().__init__(owner, frame)
        self.yields: list[int] = []  # of the switch expressions around: the slot for the value
        self.in_constructor = False

    # -- help -------------------------------------------------------------------------------

    def refuse(self, message: str, node: Node) -> Code:
        """Write an error down; the value is unknown, so that the rest can be looked at, too."""
        self.program.error(message, self.at(node))
        return self.make_unknown(node)

    def compile(self, node: Node) -> Code:
        """Compile an expression."""
        return self.apply_method(node) or self.make_unknown(node)

    def apply_method(self, node: Node) -> Any:
        """What the method of a node's type gives, which takes the node and the parts it names."""
        method = getattr(self, f"_{node.type}", None)
        if method is None:
            return None
        names = _list_parts(method.__func__)
        return method(node, *map(node.child_by_field_name, names))

    def make_unknown(self, node: Node) -> Code:
        """Compile an expression that is not run here: its value is unknown."""
        unknown = Unknown(text(node)[:LONGEST_TEXT])
        return Code(lambda _env: unknown, place=lambda _env: (unknown, ""))

    def coerce(self, code: Code, kind: str, node: Node) -> Run:
        """Compile the conversion of an assignment, or write down that Java refuses it."""
        refusal = self.explain_refusal(kind, code)
        if refusal:
            return self.refuse(refusal, node).run
        run, owner = code.run, self.owner
        if kind in PRIMITIVES:
            if kind == code.kind:
                return run
        elif kind in {"", "String", code.kind}:
            return run
        return lambda env: owner.convert(kind, run(env))

    # -- literals ---------------------------------------------------------------------------

    def _number(self, node: Node) -> Code:
        found = read_number(text(node))
        if found is None:
            return self.refuse(f"{text(node)[:LONGEST_TEXT]} is too large a number", node)
        return _constant(*found)

    _decimal_integer_literal = _hex_integer_literal = _number
    _binary_integer_literal = _decimal_floating_point_literal = _number

    def _string_literal(self, node: Node) -> Code:
        found = read_string(text(node))
        kind = "char" if node.type == "character_literal" else "String"
        return self.make_unknown(node) if found is None else _constant(found, kind)

    _character_literal = _string_literal

    def _true(self, _node: Node) -> Code:
        return _constant(True, "boolean")

    def _false(self, _node: Node) -> Code:
        return _constant(False, "boolean")

    def _null_literal(self, _node: Node) -> Code:
        return Code(lambda _env: None, "null")

    def _parenthesized_expression(self, node: Node) -> Code:
        return self.compile(next(named(node)))

    # -- names ------------------------------------------------------------------------------

    def _this(self, node: Node) -> Code:
        if self.frame.static:
            return self.refuse("a static method has no `this`", node)
        return Code(lambda env: env[THIS], self.owner.name)

    def _compile_path_to_outer(self, keys: Sequence[str]) -> Callable[[Env], Env]:
        """Code that leads from the variables of a method to those of an outer class."""
        if not keys:
            return lambda env: env

        def run(env: Env) -> Env:
            for key in keys:
                env = env[THIS].__dict__[key]
            return env

        return run

    def _list_frames(self) -> Any:
        """The frames from the current one outward, each with the keys that lead to it."""
        frame: Frame | None = self.frame
        keys: list[str] = []
        while frame is not None:
            yield frame, tuple(keys)
            keys.append(frame.owner.env_key)
            frame = frame.outer

    def find_variable(self, name: str) -> tuple[Any, ...] | None:
        """The variable that a simple name refers to, or None.

        Returns:
            ``("local", keys, Local)``, ``("field", keys, owner, Field)``, or ``("library", keys)``
            for a field of a library's class.
        """
        for frame, keys in self._list_frames():
            local = frame.find(name)
            if local is not None:
                return "local", keys, local
            found = frame.owner.find_field(name)
            if found is not None:
                return "field", keys, *found
            base = frame.owner.library_base
            if (
                isinstance(base, type)
                and not name.startswith("_")
                and name not in vars(Fake)
                and (
                    runtime.find_attribute(base, name) is not None
                    or name in getattr(base, "__annotations__", ())
                )
            ):
                return "library", keys
        one = self.owner.outer
        while one is not None:
            found = one.find_field(name)
            if found is not None and found[1].static:
                return "field", (), *found
            one = one.outer
        return None

    def _identifier(self, node: Node, *, assigned: bool = False) -> Code:
        name = text(node)
        found = self.find_variable(name)
        if found is None:
            return self._find_imported_field(name) or self._unknown_name(name, node)
        reach = self._compile_path_to_outer(found[1])
        if found[0] == "local":
            return self._compile_local(found[1], found[2])
        if found[0] == "library":
            run = lambda env: runtime.get_field(reach(env)[THIS], name)
            return Code(run, place=lambda env: (reach(env)[THIS], name))
        _, keys, owner, one = found
        below = owner is self.owner and not keys and 0 <= self.frame.field_rank <= one.rank
        if below and one.static == self.frame.static and not assigned:
            return self.refuse(f"illegal forward reference: {name} is declared below", node)
        return self._compile_field(keys, owner, one, node)

    def _compile_local(self, keys: Sequence[str], local: Local) -> Code:
        slot = local.slot
        reach = self._compile_path_to_outer(keys)
        fixed = f"cannot assign a value to final variable {local.name}" if local.final else ""
        if keys or local.depth < self.frame.depth:
            fixed = (
                f"{local.name} cannot be changed in a lambda or class: it must be effectively final"
            )
        run = lambda env: reach(env)[slot] if keys else env[slot]
        return Code(run, local.kind, lambda env: (reach(env), slot), fixed)

    def _compile_field(self, keys: Sequence[str], owner: JavaClass, one: Field, node: Node) -> Code:
        key, kind = one.key, self.translate_type(owner, one.kind)
        fixed = self._why_fixed(owner, one)
        if one.static:
            place = lambda _env: (owner.initialize(), key)
            return Code(lambda _env: owner.initialize()[key], kind, place, fixed)
        level = next((f for f, k in self._list_frames() if tuple(k) == tuple(keys)), self.frame)
        if level.static:
            return self.refuse(
                f"{one.name} belongs to an object, and this is a static method", node
            )
        reach = self._compile_path_to_outer(keys)
        place = lambda env: (reach(env)[THIS].__dict__, key)
        return Code(lambda env: reach(env)[THIS].__dict__[key], kind, place, fixed)

    def _why_fixed(self, owner: JavaClass, one: Field) -> str:
        """What javac says of an assignment to a final field; empty if it may be assigned here."""
        first = owner is self.owner and self.in_constructor and one.value is None
        return f"cannot assign a value to final variable {one.name}" * (one.final and not first)

    def _find_imported_field(self, name: str) -> Code | None:
        """A field that a static import brings."""
        for cls, _ in self._list_static_imports(name):
            code = self._static_member(cls, name)
            if code is not None:
                return code
        return None

    def _list_static_imports(self, name: str) -> Iterator[tuple[Any, bool]]:
        """The classes of which a static import may bring a name, and whether it says the name."""
        for one in self.owner.unit.imports:
            if one.static and (one.star or one.name == name):
                full = one.full if one.star else one.full.rpartition(".")[0]
                cls = self.program.load(full)
                if cls is None:
                    self.program.unknown.setdefault(full, one.at)
                yield Unknown(full) if cls is None else cls, not one.star

    def _static_member(self, cls: Any, name: str) -> Code | None:
        """A static field of a class; None if it has none of this name."""
        if isinstance(cls, JavaClass):
            found = cls.find_field(name)
            if found is not None:
                return self._compile_field((), *found, cls.node) if found[1].static else None
            cls = cls.library_base
        if cls is None:
            return None
        found = None if isinstance(cls, Unknown) else runtime.find_attribute(cls, name)
        none = found is None and isinstance(cls, type) and getattr(cls, "fake_complete", True)
        if none or isinstance(found, types.FunctionType | staticmethod | classmethod):
            return None
        kind = KINDS.get(type(found), type(found).__name__ if found is not None else "")
        kind = BOXES.get(getattr(cls, "__name__", ""), kind)
        if found is None or isinstance(found, property | Unknown):
            place = lambda _env: (cls, name)
            return Code(lambda _env: runtime.get_static(cls, name), kind, place)
        value = runtime.get_static(cls, name)  # the fakes' static fields are constants
        return Code(lambda _env: value, kind)

    def _unknown_name(self, name: str, node: Node) -> Code:
        unit = self._find_unit(name)
        if unit:
            return self.refuse(unit, node)
        if packages_of(name):
            self.program.resolve_or_report(name, self.owner, self.at(node), self.frame)
            return self.refuse(f"{name} is a class and no value", node)
        if name[:1].isupper() and self.resolve(name) is None and not name.isupper():
            found = self.program.resolve_or_report(name, self.owner, self.at(node), self.frame)
            return Code(lambda _env: found)
        seen = [one.name for frame, _ in self._list_frames() for one in frame.every]
        for frame, _ in self._list_frames():
            seen += [one for owner in frame.owner.ancestors() for one in owner.fields]
        return self.refuse(unknown_name("name", name, seen, ""), node)

    def _find_unit(self, name: str) -> str:
        """What to say of a unit that is not imported, or not quite a unit's name."""
        units = self.program.load(UNITS)
        season = any(one.full.startswith("org.wpilib.") for one in self.owner.unit.imports)
        home = UNITS_2027 if season else UNITS
        if self._static_member(units, name):
            return f"{name} is not imported. Write at the top: import static {home}.{name};"
        near = difflib.get_close_matches(name, [*vars(units)], 1, NEARLY)
        return f"unknown name {name}. Did you mean {near[0]}?" if near else ""

    def find_named_class(self, node: Node) -> Any:
        """The class that an expression names; None if it is a value."""
        if node.type not in {
            "identifier",
            "field_access",
            "scoped_identifier",
            "type_identifier",
            "generic_type",
            "array_type",
            "scoped_type_identifier",
        }:
            return None
        name = kind_of(node)
        first = name.partition(".")[0]
        if node.type in {"identifier", "field_access"}:
            if any(one.type not in {"identifier", ".", "field_access"} for one in node.children):
                return None
            if self.find_variable(first) is not None:
                return None
        found = self.resolve(name)
        unsaid = found is None and name[:1].isupper() and "." not in name
        if unsaid and self._find_imported_field(name) is None and not self._find_unit(name):
            found = self.program.resolve_or_report(name, self.owner, self.at(node), self.frame)
        return found

    def _field_access(self, node: Node, object_: Node, field: Node) -> Code:
        name = text(field)
        if name == "this":
            return self._outer_this(object_)
        if object_.type == "super":
            run = lambda env: runtime.get_field(env[THIS], name)
            return Code(run, place=lambda env: (env[THIS], name))
        cls = self.find_named_class(object_)
        if cls is not None:
            if isinstance(cls, Unknown):
                run = lambda _env: runtime.get_static(cls, name)
                return Code(run, place=lambda _env: (cls, name))
            code = self._static_member(cls, name)
            if code is not None:
                return code
            names = member_names(cls)
            return self.refuse(unknown_name("field", name, names, _label(cls)), node)
        whole = self.find_named_class(node)
        if whole is not None:
            return Code(lambda _env: whole)
        return self._compile_field_of(self.compile(object_), name, node, own=object_.type == "this")

    def _compile_field_of(self, value: Code, name: str, node: Node, *, own: bool) -> Code:
        run, at = value.run, self.at(node)
        found = self.resolve(value.kind) if value.kind and not value.kind.endswith("[]") else None
        if name == "length" and value.kind.endswith("[]"):
            return Code(lambda env: runtime.get_field(run(env), "length"), "int")
        if isinstance(found, JavaClass):
            there = found.find_field(name)
            if there is None and found.library_base is None:
                return self.refuse(self.describe_unknown_field(found, name), node)
            if there is not None and there[1].static:
                return self._compile_field((), *there, node)
            if there is not None:
                key, kind = there[1].key, self.translate_type(there[0], there[1].kind)

                def run_field(env: Env) -> Any:
                    one = run(env)
                    try:
                        return one.__dict__[key]
                    except (AttributeError, KeyError):
                        STATE.at = at
                        return runtime.get_field(one, name)

                fixed = self._why_fixed(*there) if own else ""
                return Code(run_field, kind, lambda env: (run(env), key[1:]), fixed)

        def run_any(env: Env) -> Any:
            one = run(env)
            STATE.at = at
            return runtime.get_field(one, name)

        return Code(run_any, place=lambda env: (run(env), name))

    def _outer_this(self, node: Node) -> Code:
        wanted = self.find_named_class(node)
        for frame, keys in self._list_frames():
            if frame.owner is wanted:
                return Code(_this_of(self._compile_path_to_outer(keys)), frame.owner.name)
        return self.refuse(f"there is no {text(node)}.this here", node)

    # -- arithmetic -------------------------------------------------------------------------

    def _binary_expression(self, node: Node, left: Node, operator: Node, right: Node) -> Code:
        return self.operate(text(operator), self.compile(left), self.compile(right), node)

    def operate(self, sign: str, left: Code, right: Code, node: Node) -> Code:
        """Compile an operator of two values."""
        a, b = left.run, right.run
        kinds = BOXES.get(left.kind, left.kind), BOXES.get(right.kind, right.kind)
        if sign in {"&&", "||"}:
            both = sign == "&&"
            return Code(lambda env: (a(env) and b(env)) if both else (a(env) or b(env)), "boolean")
        exact, at = OPERATORS.get(sign), self.at(node)
        characters = "char" in kinds and "String" not in kinds and sign not in {"==", "!="}
        if exact is None or characters:
            return self.make_unknown(node)

        def run(env: Env) -> Any:
            one, other = a(env), b(env)
            STATE.at = at
            result = exact(one, other)
            return values.check_range(result) if kind == "int" else result

        kind = "boolean" if sign in COMPARISONS else promoted(sign, *kinds)
        return Code(run, kind)

    def _unary_expression(self, node: Node, operator: Node, operand: Node) -> Code:
        sign = text(operator)
        if sign == "-" and operand.type == "decimal_integer_literal":
            found = read_number("-" + text(operand))
            if found is not None:
                return _constant(*found)
        one = self.compile(operand)
        run = one.run
        if sign == "!":

            def negate(env: Env) -> Any:
                value = run(env)
                return value if isinstance(value, Unknown) else not value

            return Code(negate, "boolean")
        if sign == "-":
            return self.operate("*", one, _constant(-1, "int"), node)
        return one if sign == "+" else self.make_unknown(node)

    def _ternary_expression(
        self, _node: Node, condition: Node, consequence: Node, alternative: Node
    ) -> Code:
        ask = self.condition(condition)
        yes, no = self.compile(consequence), self.compile(alternative)
        kind = join_codes([yes, no])
        a, b = yes.run, no.run
        return Code(lambda env: a(env) if ask(env) else b(env), kind)

    def condition(self, node: Node) -> Run:
        """Compile a condition."""
        code = self.compile(node)
        if code.kind in {*PRIMITIVES, *BOXES, "String"} - {"boolean", "Boolean"}:
            return self.refuse(
                f"a condition has to be true or false, and this is of type {code.kind}", node
            ).run
        return code.run

    def _instanceof_expression(
        self, _node: Node, left: Node, right: Node, name: Node | None
    ) -> Code:
        tested, kind = self.compile(left).run, kind_of(right)
        cls = self.find_type(right)
        local = self.frame.declare(text(name), kind) if name is not None else None

        def run(env: Env) -> Any:
            value = tested(env)
            found = is_instance(value, kind, cls)
            if local is not None and found:
                env[local.slot] = value
            return found

        return Code(run, "boolean")

    def _cast_expression(self, node: Node, type_: Node, value: Node) -> Code:
        kind = self.erased(kind_of(type_))
        code = self.compile(value)
        run, owner = code.run, self.owner
        refusal = self.explain_unrelated_types(kind, code)
        if refusal:
            return self.refuse(refusal, node)
        if kind in PRIMITIVES:
            return Code(lambda env: values.cast(kind, run(env)), kind)
        if kind:
            self.find_type(type_)
        return Code(lambda env: owner.convert(kind, run(env)), kind)

    # -- assignment -------------------------------------------------------------------------

    def target(self, node: Node) -> tuple[str, Place]:
        """What can be assigned: its type, and what finds its place."""
        name = node.type == "identifier"
        code = self._identifier(node, assigned=True) if name else self.compile(node)
        if code.fixed:
            self.refuse(code.fixed, node)
        if code.place is None:
            code = self.refuse("nothing can be assigned to this expression", node)
        return code.kind, code.place

    def _assignment_expression(self, node: Node, left: Node, operator: Node, right: Node) -> Code:
        sign = text(operator)
        if sign == "=":
            kind, find = self.target(left)
            value, at = self.coerce(self.compile(right), kind, node), self.at(node)

            def assign(env: Env) -> Any:
                place = find(env)
                new = value(env)
                STATE.at = at
                write_place(place, new)
                return new

            return Code(assign, kind)
        return self._compile_compound_assignment(
            left, sign[:-1], self.compile(right), node, after=True
        )

    def _update_expression(self, node: Node) -> Code:
        target = next(named(node))
        sign = "+" if any(one.type == "++" for one in node.children) else "-"
        after = node.children[0].type in {"++", "--"}
        return self._compile_compound_assignment(
            target, sign, _constant(1, "int"), node, after=after
        )

    def _compile_compound_assignment(
        self, target: Node, sign: str, right: Code, node: Node, *, after: bool
    ) -> Code:
        kind, find = self.target(target)
        at = self.at(node)
        slot = self.frame.declare(f"{node.start_byte} old", kind).slot
        old = Code(lambda env: env[slot], kind)
        operated = self.operate(sign, old, right, node)
        box = BOXES.get(kind, kind)
        narrow = box in PRIMITIVES and operated.kind != box

        def run(env: Env) -> Any:
            place = find(env)
            STATE.at = at
            before = env[slot] = read_place(place)
            new = operated.run(env)
            if narrow:
                new = values.cast(box, new)
            write_place(place, new)
            return new if after else before

        return Code(run, kind)

    # -- arrays -----------------------------------------------------------------------------

    def _array_access(self, node: Node, array: Node, index: Node) -> Code:
        whole, place = self.compile(array), self.compile(index).run
        holder, kind = whole.run, whole.kind[:-2] if whole.kind.endswith("[]") else ""
        find, at = lambda env: (holder(env), place(env)), self.at(node)

        def run(env: Env) -> Any:
            found = find(env)
            STATE.at = at
            return type_names.array_get(*found)

        return Code(run, kind, find)

    def _array_creation_expression(self, node: Node, type_: Node, value: Node | None) -> Code:
        kind = kind_of(type_)
        self.find_type(type_)
        sizes = [
            self.coerce(self.compile(next(named(one))), "int", one)
            for one in node.children
            if one.type == "dimensions_expr"
        ]
        empty = sum(text(one).count("[") for one in node.children if one.type == "dimensions")
        if value is not None:
            return self.compile_array(value, kind + "[]" * empty)
        whole = kind + "[]" * (len(sizes) + empty)
        return Code(lambda env: type_names.make_array(whole, [size(env) for size in sizes]), whole)

    def initial_value(self, node: Node, kind: str) -> Run:
        """Compile the first value of a variable or field of a type."""
        if node.type == "array_initializer":
            return self.compile_array(node, kind).run
        return self.coerce(self.compile(node), self.erased(kind), node)

    def compile_array(self, node: Node, kind: str) -> Code:
        """Compile ``{1, 2}`` as an array of a type."""
        inner = kind.removesuffix("[]")
        runs = [self.initial_value(one, inner) for one in named(node)]
        return Code(lambda env: Array([run(env) for run in runs], inner), kind)

    # -- calls ------------------------------------------------------------------------------

    def arguments(self, node: Node | None) -> Arguments:
        """Compile arguments."""
        codes = [self.compile(one) for one in named(node)] if node is not None else []
        runs = [one.run for one in codes]
        return Arguments(lambda env: [run(env) for run in runs], codes)

    def _method_invocation(
        self, node: Node, object_: Node | None, name: Node, arguments: Node
    ) -> Code:
        return self._invoke(node, object_, text(name), self.arguments(arguments))

    def _invoke(self, node: Node, object_: Node | None, name: str, args: Arguments) -> Code:
        if any(one.type == "super" for one in node.children):
            return self._compile_super_call(object_, name, args, node)
        if object_ is None:
            return self._compile_own_call(name, args, node)
        cls = self.find_named_class(object_)
        if cls is not None:
            return self._compile_static_call(cls, name, args, node)
        value = self.compile(object_)
        if value.kind in PRIMITIVES:
            return self.refuse(
                f"a value of type {value.kind} has no methods, so .{name}() cannot follow it", node
            )
        holder = self.resolve(value.kind) if value.kind else None
        found = None
        if isinstance(holder, JavaClass) and not value.kind.endswith("[]"):
            found = runtime.find_attribute(holder.cls, name)
            if found is not None and _is_static(found):
                return self._compile_static_call(holder, name, args, node)
        return Code(self.call(value.run, name, args, node), self.find_result_type(found))

    def call(self, value: Run, name: str, args: Arguments, node: Node) -> Run:
        """Compile a method call on a value whose class is known only at run time."""
        at, arguments, kinds = self.at(node), args.run, args.kinds
        callers: dict[type, runtime.Call] = {}

        def run(env: Env) -> Any:
            one = value(env)
            given = arguments(env)
            STATE.at = at
            kind = type(one)
            try:
                caller = callers.get(kind)
                if caller is None:
                    caller = callers[kind] = runtime.find_caller(kind, name, kinds)
                return caller(one, given)
            except (NoSuchMember, TypeError) as problem:
                return self.record_mismatch(problem, at, name)

        return run

    def record_mismatch(self, problem: Exception, at: At, name: str) -> Unknown:
        """Record a call that javac would refuse; its result is unknown."""
        said = str(problem)
        if not isinstance(problem, NoSuchMember | WrongArgument):
            if not runtime.is_about_arguments(problem):
                raise problem
            said = f"{name} takes another number of arguments"
        self.program.error(said, at, name)
        return Unknown(f"{name}()")

    def _compile_own_call(self, name: str, args: Arguments, node: Node) -> Code:
        """Compile a call without a receiver: of this object, an outer one, or a static import."""
        for frame, keys in self._list_frames():
            owner = frame.owner
            found = runtime.find_attribute(owner.cls, name)
            if found is None and name not in getattr(owner.cls, "fake_others", ()):
                continue
            if found is not None and _is_static(found):
                return self._compile_static_call(owner, name, args, node)
            if frame.static:
                return self.refuse(
                    f"{name}() belongs to an object, and this is a static method", node
                )
            reach, overloads = self._compile_path_to_outer(keys), getattr(found, "overloads", None)
            this = lambda env, reach=reach: reach(env)[THIS]
            private = overloads and all("private" in one.modifiers for one in overloads.methods)
            run = (
                self._call_overloads(overloads, args, node, this)
                if private
                else self.call(this, name, args, node)
            )
            return Code(run, self.find_result_type(found))
        one: JavaClass | None = self.owner
        while one is not None:
            if runtime.find_attribute(one.cls, name) is not None:
                return self._compile_static_call(one, name, args, node)
            one = one.outer
        for cls, said in self._list_static_imports(name):
            sure = said or isinstance(cls, Unknown)
            if sure or runtime.find_attribute(python_class(cls), name) is not None:
                return self._compile_static_call(cls, name, args, node)
        if self.frame.static:
            return self.refuse(unknown_name("method", name, member_names(self.owner), ""), node)
        base = self.owner.library_base
        if isinstance(base, Unknown) or not has_known_members(self.owner):
            unknown = Unknown(name)
            return Code(
                lambda env: getattr(env[THIS], runtime.python_name(name), unknown)(*args.run(env))
            )
        names = [one for frame, _ in self._list_frames() for one in member_names(frame.owner)]
        if name in runtime.OBJECT_METHODS:
            return Code(self.call(lambda env: env[THIS], name, args, node))
        return self.refuse(unknown_name("method", name, names, ""), node)

    def _call_overloads(
        self, overloads: Any, args: Arguments, node: Node, this: Run = lambda _env: None
    ) -> Run:
        call = lambda env, given: overloads.call(this(env), given, args.kinds)
        return self._compile_known_call(overloads.name, call, args, node)

    def _compile_known_call(
        self, name: str, call: Callable[[Env, list[Any]], Any], args: Arguments, node: Node
    ) -> Run:
        """Compile a call of a known method; a call that javac would refuse is recorded."""
        at, arguments = self.at(node), args.run

        def run(env: Env) -> Any:
            given = arguments(env)
            STATE.at = at
            try:
                return call(env, given)
            except (NoSuchMember, TypeError) as problem:
                return self.record_mismatch(problem, at, name)

        return run

    def _compile_static_call(self, cls: Any, name: str, args: Arguments, node: Node) -> Code:
        found = runtime.find_attribute(cls.cls, name) if isinstance(cls, JavaClass) else None
        overloads = getattr(found, "overloads", None)
        if overloads is not None:
            if not _is_static(found, surely=True):
                return self.refuse(
                    f"{name}() belongs to an object: {cls.name} is the class, not one of those",
                    node,
                )
            prepare = lambda _env: (cls.initialize(), None)[1]
            run = self._call_overloads(overloads, args, node, prepare)
            return Code(run, self.find_result_type(found))
        library = python_class(cls)
        call_library = lambda _env, given: runtime.call_static(library, name, given)
        return Code(self._compile_known_call(name, call_library, args, node))

    def _compile_super_call(
        self, object_: Node | None, name: str, args: Arguments, node: Node
    ) -> Code:
        owner = self.owner
        above: Any = owner.parent
        if object_ is not None and object_.type != "super":
            above = self.find_named_class(object_)
        for one in [above] if above is not None else owner.interfaces:
            cls = python_class(one)
            found = runtime.find_attribute(cls, name) if isinstance(cls, type) else None
            overloads = getattr(found, "overloads", None)
            if overloads is not None:
                run = self._call_overloads(overloads, args, node, lambda env: env[THIS])
                return Code(run, self.find_result_type(found))
            if found is not None:
                return Code(lambda env, found=found: found(env[THIS], *args.run(env)))
        if name in runtime.OBJECT_METHODS:
            return Code(lambda env: runtime.OBJECT_METHODS[name](env[THIS], *args.run(env)))
        return Code(lambda _env: Unknown(f"super.{name}"))

    def _object_creation_expression(self, node: Node, type_: Node, arguments: Node) -> Code:
        kind, args = kind_of(type_), self.arguments(arguments)
        if node.children[0].type != "new":  # of an inner class, of another object
            return self.make_unknown(node)
        if child(node, "class_body") is not None:
            cls = JavaClass("", node, self.owner.unit, outer=self.owner, frame=self.frame)
            _ = cls.cls
        else:
            cls = self.find_type(type_)
        if isinstance(cls, JavaClass):
            if cls.name and ("abstract" in cls.modifiers or cls.form in {"interface", "enum"}):
                what = "an enum" if cls.form == "enum" else "abstract"
                return self.refuse(f"{cls.name} is {what}: new cannot make an object of it", node)
            around = self._compile_environment(cls)
            create = lambda env, given: cls.make(given, args.kinds, around(env) if around else None)
            named_kind = kind if cls.name else ""
        elif cls is None:  # a type variable
            return self.refuse(f"new cannot make an object of {kind}", node)
        elif isinstance(cls, type) and issubclass(cls, Enum):
            return self.refuse(f"{kind} is an enum: new cannot make an object of it", node)
        else:
            create, named_kind = lambda _env, given: cls(*given), kind

        return Code(self._compile_known_call(f"new {kind}", create, args, node), named_kind)

    def _compile_environment(self, cls: JavaClass) -> Callable[[Env], Env] | None:
        """The variables around a class that its new object can read."""
        if cls.static:
            return None
        for frame, keys in self._list_frames():
            reach = self._compile_path_to_outer(keys)
            if cls.frame is not None:
                if frame is cls.frame:
                    return lambda env, reach=reach: list(reach(env))
            elif cls.outer in frame.owner.ancestors() and not frame.static:
                return lambda env, reach=reach: [reach(env)[THIS], None]
        return None

    # -- functions --------------------------------------------------------------------------

    def _lambda_expression(self, node: Node, parameters: Node, body: Node) -> Code:
        frame, at = self.frame, self.at(node)
        frame.push()
        frame.depth += 1
        listed = [parameters] if parameters.type == "identifier" else list(named(parameters))
        locals_: list[Local] = []
        for one in listed:
            name = text(one) if one.type == "identifier" else text(one.child_by_field_name("name"))
            kind = kind_of(one.child_by_field_name("type")) if one.type != "identifier" else ""
            locals_.append(frame.declare(name, "" if kind == "var" else self.erased(kind)))
        yields, self.yields = self.yields, []
        compute, gives = self.lambda_body(body)
        self.yields = yields
        frame.depth -= 1
        frame.pop()
        slots = [(one.slot, one.kind) for one in locals_]
        count, owner = len(slots), self.owner

        def run(env: Env) -> Any:
            captured = list(env)

            def call(*args: Any) -> Any:
                inner = list(captured)
                for (slot, kind), value in zip(slots, args, strict=True):
                    inner[slot] = owner.convert(kind, value) if kind else value
                return compute(inner)

            return Function(call, at, count, gives)

        return Code(run, "lambda")

    def lambda_body(self, node: Node) -> tuple[Run, bool | None]:
        """Compile the body of a lambda, and tell whether it gives a value; None if either.

        A block needs statements, which the subclass knows.
        """
        raise NotImplementedError

    def _method_reference(self, node: Node) -> Code:
        first, last = node.children[0], node.children[-1]
        name, at = text(last), self.at(node)
        if first.type == "super":
            return self.make_unknown(node)
        if first.type == "array_type":
            kind = kind_of(first)
            make = lambda count: type_names.make_array(kind, [count])
            return Code(lambda _env: Function(make, at, 1), "lambda")
        cls = self.find_named_class(first)
        if cls is not None and name == "new":
            return self._constructor_reference(cls, at)
        if cls is not None:
            return self._class_reference(cls, name, node)
        value = self.compile(first)
        kind = self.owner.name if first.type == "this" else value.kind
        if kind in PRIMITIVES:
            return self.refuse(f"a value of type {kind} has no methods", node)
        run = value.run

        def bound(env: Env) -> Any:
            one = run(env)
            STATE.at = at
            if one is None:
                raise values.NullPointerException(f"{text(first)} is null")
            caller = runtime.find_caller(type(one), name, ())
            arity = _count_parameters(runtime.find_attribute(type(one), name))
            return Function(lambda *args: self._call_at(at, caller, one, args), at, arity)

        return Code(bound, "lambda")

    def _constructor_reference(self, cls: Any, at: At) -> Code:
        if not isinstance(cls, JavaClass):
            return Code(lambda _env: Function(cls, at), "lambda")
        around = self._compile_environment(cls)
        arities = {len(one.kinds) for one in cls.constructors}
        arity = arities.pop() if len(arities) == 1 else -1

        def run(env: Env) -> Function:
            return Function(lambda *a: cls.make(a, (), around(env) if around else None), at, arity)

        return Code(run, "lambda")

    def _class_reference(self, cls: Any, name: str, node: Node) -> Code:
        """``Type::method``: a static method, or one of the first argument."""
        at = self.at(node)
        if isinstance(cls, Unknown):
            one = Function(getattr(cls, runtime.python_name(name)), at)
            return Code(lambda _env: one, "lambda")
        found = runtime.find_attribute(python_class(cls), name)
        overloads = getattr(found, "overloads", None)

        def call(*args: Any) -> Any:
            STATE.at = at
            if overloads is not None:
                method, _ = overloads.choose(args, ())
                if method is not None and method.static:
                    return overloads.call(None, args, ())
            elif not args or isinstance(found, staticmethod | classmethod):
                return runtime.call_static(cls, name, args)
            elif found is None and not (
                isinstance(args[0], Function) or is_instance(args[0], _label(cls), cls)
            ):
                return runtime.call_static(python_class(cls), name, args)
            return runtime.find_caller(type(args[0]), name, ())(args[0], args[1:])

        arity = _count_parameters(found)
        if arity >= 0 and not isinstance(found, staticmethod | classmethod):
            arity += 1
        return Code(lambda _env: Function(call, at, arity), "lambda")

    @staticmethod
    def _call_at(at: At, caller: runtime.Call, value: Any, args: Sequence[Any]) -> Any:
        STATE.at = at
        return caller(value, args)


@functools.cache
def _list_parts(method: Callable[..., Any]) -> list[str]:
    """The parts of a node that a method takes besides the node, by their names in the grammar."""
    every = list(inspect.signature(method).parameters.values())[2:]
    return [one.name.rstrip("_") for one in every if one.kind is one.POSITIONAL_OR_KEYWORD]


def _count_parameters(found: Any) -> int:
    """The number of arguments that a method takes; -1 if it is unknown."""
    overloads = getattr(found, "overloads", None)
    if overloads is not None:
        counts = {-1 if one.varargs else len(one.kinds) for one in overloads.methods}
        return counts.pop() if len(counts) == 1 and overloads.inherited is None else -1
    if not isinstance(found, types.FunctionType):
        return -1
    listed = list(inspect.signature(found).parameters.values())[1:]
    sure = all(one.kind is one.POSITIONAL_OR_KEYWORD and one.default is one.empty for one in listed)
    return len(listed) if sure else -1


def _is_static(found: Any, *, surely: bool = False) -> bool:
    """Whether a member belongs to its class; with ``surely``, whether some overload does."""
    overloads = getattr(found, "overloads", None)
    if overloads is not None:
        any_or_all = any if surely else all
        return any_or_all(one.static for one in overloads.methods)
    return not isinstance(found, types.FunctionType | functools.partialmethod)


def read_place(place: tuple[Any, Any]) -> Any:
    """What stands in a place: of variables or fields, of an object, or of an array."""
    holder, key = place
    if type(holder) in (list, dict):
        return holder[key]
    if type(key) is not str:
        return type_names.array_get(holder, key)
    return (runtime.get_static if isinstance(holder, type) else runtime.get_field)(holder, key)


def write_place(place: tuple[Any, Any], value: Any) -> None:
    """Put a value into a place."""
    holder, key = place
    if type(holder) in (list, dict):
        holder[key] = value
    elif type(key) is not str:
        type_names.array_set(holder, key, value)
    else:
        runtime.set_field(holder, key, value)


def _label(cls: Any) -> str:
    return str(cls.name if isinstance(cls, JavaClass) else cls.__name__)


def _this_of(reach: Callable[[Env], Env]) -> Run:
    return lambda env: reach(env)[THIS]


def _constant(value: Any, kind: str) -> Code:
    return Code(lambda _env: value, kind)


def is_instance(value: Any, kind: str, cls: Any) -> Any:
    """Java's instanceof."""
    if value is None:
        return False
    if isinstance(value, Unknown) or isinstance(cls, Unknown):
        return value if isinstance(value, Unknown) else cls
    if kind.endswith("[]"):
        return isinstance(value, Array)
    if isinstance(cls, JavaClass):
        cls = cls.cls
    if isinstance(cls, type) and isinstance(value, cls):
        return True
    return type_names.is_instance(value, kind)


__all__ = ["RESULT", "ExpressionCompiler"]
