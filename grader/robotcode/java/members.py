"""The members that the text of a Java class declares, compiled on first use."""

import re
from collections.abc import Callable
from typing import Any

from tree_sitter import Node

from grader.robotcode.java import values
from grader.robotcode.java.classes import JavaClass, Method, modifiers_of
from grader.robotcode.java.runtime import STATE, enter, enum_static
from grader.robotcode.java.scope import (
    RESULT,
    THIS,
    Arguments,
    Code,
    Env,
    Field,
    Frame,
    child,
    kind_of,
    named,
    text,
)
from grader.robotcode.java.statement_compiler import StatementCompiler, falls_through
from grader.robotcode.java.values import PRIMITIVES
from grader.robotcode.library.base import Unknown


def declare_members(owner: JavaClass) -> None:
    """Declare the fields, methods and constructors of a class."""
    if owner.form == "record":
        _declare_components(owner)
    for number, node in enumerate(owner.members):
        if node.type in {"field_declaration", "constant_declaration"}:
            _declare_fields(owner, node, number)
        elif node.type in {
            "method_declaration",
            "constructor_declaration",
            "compact_constructor_declaration",
        }:
            _declare_method(owner, node)
        elif node.type == "enum_constant":
            name = text(node.child_by_field_name("name"))
            owner.constants.append((name, node))
            owner.fields[name] = Field(
                name, owner.name, True, True, f".{name}", number, owner.unit.source.at(node)
            )
    if owner.form == "record":
        _declare_canonical(owner)
        for name, kind in owner.components:
            _add_method(owner, name, [], kind, _make_reader(name))
        _add_method(owner, "hashCode", [], "int", _hash_record)
        _add_method(owner, "equals", ["Object"], "boolean", _are_equal_records)

    if owner.form == "enum":
        ask = lambda name, *args: enum_static(owner.list_constants(), owner.name, name, args)
        _add_method(owner, "values", [], f"{owner.name}[]", lambda _: ask("values"), "static")
        one = lambda _, name: ask("valueOf", name)
        _add_method(owner, "valueOf", ["String"], owner.name, one, "static")


def _declare_canonical(owner: JavaClass) -> None:
    """Give a record the constructor that takes all components, if its text has none."""
    names, kinds = ([one[at] for one in owner.components] for at in (0, 1))
    if all(one.kinds != kinds for one in owner.constructors):
        made = Method(owner, owner.name, names, kinds, False, frozenset(), "", owner.at, owner.node)
        made.run = lambda this, *args: this.__dict__.update(
            zip((f".{name}" for name in names), args, strict=True)
        )
        owner.constructors.append(made)


def compile_members(owner: JavaClass) -> None:
    """Compile the initializers of the class and its objects, and all methods."""
    for number, (name, node) in enumerate(owner.constants):
        owner.on_class.append(_compile_enum_constant(owner, name, node, number))
    for one in owner.fields.values():
        if one.static:
            owner.statics[one.key] = values.default_value(one.kind)
    for number, node in enumerate(owner.members):
        if node.type in {"field_declaration", "constant_declaration"}:
            for declarator in node.children_by_field_name("declarator"):
                _initialize_field(owner, text(declarator.child_by_field_name("name")), number)
        elif node.type == "static_initializer":
            owner.on_class.append(_compile_initializer(owner, next(named(node)), static=True))
        elif node.type == "block":
            owner.on_instance.append(_compile_initializer(owner, node, static=False))
    if owner.unit is owner.unit.program.unit:  # the rest of a program only as far as it is used
        for method in (*owner.methods, *owner.constructors):
            _ = method.run


def _declare_fields(owner: JavaClass, node: Node, rank: int) -> None:
    modifiers = modifiers_of(node)
    base = kind_of(node.child_by_field_name("type"))
    constant = owner.form in {"interface", "annotation"}
    for one in node.children_by_field_name("declarator"):
        name = text(one.child_by_field_name("name"))
        kind = base + "[]" * text(one.child_by_field_name("dimensions")).count("[")
        above = owner.parent.find_field(name) if isinstance(owner.parent, JavaClass) else None
        key = f".{name}" if above is None else f".{name}@{owner.name}"
        at = owner.unit.source.at(one)
        static, final = constant or "static" in modifiers, constant or "final" in modifiers
        value = one.child_by_field_name("value")
        owner.fields[name] = Field(name, kind, static, final, key, rank, at, value)


def _declare_components(owner: JavaClass) -> None:
    for one in named(owner.node.child_by_field_name("parameters")):
        name, kind = _read_parameter(one)
        owner.components.append((name, kind))
        owner.fields[name] = Field(name, kind, False, True, f".{name}", -1, owner.at)


def _add_method(
    owner: JavaClass, name: str, kinds: list[str], returns: str, run: Callable[..., Any], *more: str
) -> None:
    """Give a record or an enum a method that its text does not have, with more modifiers."""
    if not any(one.name == name and len(one.kinds) == len(kinds) for one in owner.methods):
        public = frozenset({"public", *more})
        made = Method(owner, name, kinds, kinds, False, public, returns, owner.at, owner.node)
        made.run = run
        owner.methods.append(made)


def _make_reader(name: str) -> Callable[[Any], Any]:
    return lambda this: this.__dict__[f".{name}"]


def _list_components(this: Any) -> list[Any]:
    return [this.__dict__[f".{name}"] for name, _ in type(this).java.components]


def _hash_record(this: Any) -> int:
    return hash(tuple(one for one in _list_components(this) if isinstance(one, int | float | str)))


def _are_equal_records(this: Any, other: Any) -> bool:
    same = type(this) is type(other)
    return same and all(map(values.equals, _list_components(this), _list_components(other)))


def _read_parameter(node: Node) -> tuple[str, str]:
    """The name and the type of a parameter."""
    if node.type == "spread_parameter":
        declarator = child(node, "variable_declarator")
        kinds = [one for one in named(node) if one.type not in {"modifiers", "variable_declarator"}]
        return text(declarator.child_by_field_name("name")), kind_of(kinds[0]) + "[]"
    extra = "[]" * text(node.child_by_field_name("dimensions")).count("[")
    return text(node.child_by_field_name("name")), kind_of(node.child_by_field_name("type"), extra)


def _declare_method(owner: JavaClass, node: Node) -> None:
    modifiers = modifiers_of(node)
    compact = node.type == "compact_constructor_declaration"
    every = [] if compact else named(node.child_by_field_name("parameters"))
    listed = [one for one in every if one.type != "receiver_parameter"]
    pairs = owner.components if compact else [_read_parameter(one) for one in listed]
    constructor = node.type != "method_declaration"
    body = node.child_by_field_name("body")
    returns = "" if constructor else kind_of(node.child_by_field_name("type"))
    returns += "[]" * text(node.child_by_field_name("dimensions")).count("[")
    made = Method(
        owner,
        text(node.child_by_field_name("name")),
        [name for name, _ in pairs],
        [kind for _, kind in pairs],
        bool(listed) and listed[-1].type == "spread_parameter",
        modifiers,
        returns,
        owner.unit.source.at(node),
        node,
        abstract=body is None and "native" not in modifiers,
    )
    inner = owner._type_parameters(node)
    made.kinds = ["Object" if kind.rstrip("[]") in inner else kind for kind in made.kinds]
    if inner and returns.rstrip("[]") in inner:
        made.returns = ""
    if body is not None:
        made.make = lambda: _compile_method(owner, made, body, inner)
    if constructor and made.name != owner.name:
        owner.unit.program.error(
            f"{made.name} has no return type. Is it a constructor of {owner.name}?", made.at
        )
    twins = owner.constructors if constructor else owner.methods
    twins.append(made)


def outer_frame(owner: JavaClass) -> Frame | None:
    """The frame around the methods of a class: that of a local class, or its outer object."""
    if owner.frame is not None:
        return owner.frame
    if owner.static or owner.outer is None:
        return None
    return Frame(owner.outer, static=False, outer=outer_frame(owner.outer))


def _compile_method(
    owner: JavaClass, method: Method, body: Node, variables: set[str]
) -> Callable[..., Any]:
    frame = Frame(owner, static=method.static, outer=outer_frame(owner))
    frame.variables = variables
    compiler = StatementCompiler(owner, frame)
    compiler.returns = method.returns or ("void" if method.name == owner.name else "")
    constructor = method.node.type != "method_declaration"
    compiler.in_constructor = constructor
    for name, kind in zip(method.names, method.kinds, strict=True):
        frame.declare(name, compiler.erased(kind) if kind != "Object" else "")
    parameters = method.node.child_by_field_name("parameters")
    for one in (method.node, *(named(parameters) if parameters is not None else ())):
        compiler.find_type(one.child_by_field_name("type"))
    if constructor:
        return _compile_constructor(owner, method, body, compiler)
    run = compiler.block(body)
    if method.returns not in {"void", ""} and falls_through(body):
        owner.unit.program.error(
            f"missing return statement: {method.name}() has to give a {method.returns} always",
            owner.unit.source.at(body),
        )

    def call(this: Any, *args: Any) -> Any:
        enter()
        env = frame.make_env(this, *args)
        run(env)
        STATE.depth -= 1
        return env[RESULT]

    return call


def _compile_constructor(
    owner: JavaClass, method: Method, body: Node, compiler: StatementCompiler
) -> Callable[..., Any]:
    frame = compiler.frame
    parts = list(named(body))
    first = parts[0] if parts and parts[0].type == "explicit_constructor_invocation" else None
    compact = method.node.type == "compact_constructor_declaration"
    other, args = False, Arguments(lambda _env: [], [])
    if first is not None:
        other = text(first.child_by_field_name("constructor")) == "this"
        args = compiler.arguments(first.child_by_field_name("arguments"))
    frame.push()
    runs = [compiler.statement(one) for one in parts[first is not None :]]
    frame.pop()
    components = owner.components if compact else []

    def call(this: Any, *values_: Any) -> None:
        enter()
        env = frame.make_env(this, *values_)
        given = args.run(env)
        if other:
            owner.construct(this, given, args.kinds)
        else:
            owner.construct_parent(this, given, args.kinds)
            owner.run_initializers(this)
        for one in runs:
            if one(env) is not None:
                break
        for (name, _), value in zip(components, env[RESULT + 1 :], strict=False):
            this.__dict__[f".{name}"] = value
        STATE.depth -= 1

    return call


def _initialize_field(owner: JavaClass, name: str, rank: int) -> None:
    one = owner.fields[name]
    frame = Frame(owner, static=one.static, outer=None if one.static else outer_frame(owner))
    frame.field_rank = rank
    compiler = StatementCompiler(owner, frame)
    compiler.find_type(owner.members[rank].child_by_field_name("type"))
    if one.value is None:
        return
    run, at, key = compiler.initial_value(one.value, one.kind), one.at, one.key

    def set_field(env: Env) -> None:
        STATE.at = at
        value = run(frame.make_env(env[THIS]))
        (owner.statics if one.static else env[THIS].__dict__)[key] = value

    simple = one.final and (one.kind in PRIMITIVES or one.kind == "String")
    names = set(re.findall(r"\w+", text(one.value))) & owner.fields.keys()
    if simple and "(" not in text(one.value) and names <= owner.known.keys():
        owner.known[name] = set_field
    else:
        (owner.on_class if one.static else owner.on_instance).append(set_field)


def _compile_initializer(owner: JavaClass, node: Node, *, static: bool) -> Callable[[Env], Any]:
    frame = Frame(owner, static=static, outer=None if static else outer_frame(owner))
    compiler = StatementCompiler(owner, frame)
    compiler.in_constructor = True
    run = compiler.block(node)
    return lambda env: run(frame.make_env(env[THIS]))


def _compile_enum_constant(
    owner: JavaClass, name: str, node: Node, number: int
) -> Callable[[Env], None]:
    frame = Frame(owner, static=True)
    args = StatementCompiler(owner, frame).arguments(node.child_by_field_name("arguments"))
    own_body = child(node, "class_body") is not None

    def make(_env: Env) -> None:
        if own_body:
            owner.statics[f".{name}"] = Unknown(f"{name}, a constant with a body of its own")
            return
        made = owner.cls.__new__(owner.cls)
        made._name, made._ordinal = name, number
        owner.prepare(made, None)
        owner.construct(made, args.run(frame.make_env(None)), args.kinds)
        owner.statics[f".{name}"] = made

    return make


__all__ = ["Code", "compile_members", "declare_members", "outer_frame"]
