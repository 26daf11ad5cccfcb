"""Python's expressions in the common syntax, one small function each."""

import ast

from grader.robotcode import ir
from grader.robotcode.python.to_ir import SELF, SIGNS, Lowering, Maker


def _constant(lowering: Lowering, tree: ast.Constant) -> tuple[ir.Node, ...]:
    place, value = lowering.place(tree), tree.value
    if value is None:
        return (ir.Null(place),)
    if isinstance(value, str):
        return (ir.Text(place, value),)
    if isinstance(value, int | float) and not isinstance(value, bool):
        try:
            return (ir.Number(place, float(value), integer=isinstance(value, int)),)
        except OverflowError:
            return (ir.Opaque(place),)
    return (ir.Opaque(place),)


def _name(lowering: Lowering, tree: ast.Name) -> tuple[ir.Node, ...]:
    place = lowering.place(tree)
    return (ir.Self(place) if tree.id in SELF else ir.Name(place, tree.id),)


def _attribute(lowering: Lowering, tree: ast.Attribute) -> tuple[ir.Node, ...]:
    return (ir.Member(lowering.place(tree), lowering.one(tree.value), tree.attr),)


def _subscript(lowering: Lowering, tree: ast.Subscript) -> tuple[ir.Node, ...]:
    owner, index = lowering.one(tree.value), lowering.one(tree.slice)
    return (ir.Element(lowering.place(tree), owner, index),)


def _call(lowering: Lowering, tree: ast.Call) -> tuple[ir.Node, ...]:
    args = tuple(lowering.one(arg) for arg in tree.args if not isinstance(arg, ast.Starred))
    named = tuple((word.arg, lowering.one(word.value)) for word in tree.keywords if word.arg)
    spread = len(args) + len(named) < len(tree.args) + len(tree.keywords)
    target = lowering.one(tree.func)
    if isinstance(tree.func, ast.Name) and tree.func.id == "super":
        return (ir.Name(lowering.place(tree), "super"),)
    if args and not spread and lowering.said(tree.func) in {"partial", "functools.partial"}:
        return (_partial(lowering.place(tree), args, named),)
    if isinstance(target, ir.Member):  # a chain begins far above; its method stands here
        start = target.place.end - len(target.name.encode())
        line = tree.func.end_lineno or tree.lineno
        place = ir.SourceSpan(lowering.source, start, lowering.place(tree).end, line)
        target = ir.Member(place, target.owner, target.name)
    return (ir.Call(lowering.place(tree), target, args, named=named, spread=spread),)


def _partial(
    place: ir.SourceSpan, args: tuple[ir.Node, ...], named: tuple[tuple[str, ir.Node], ...]
) -> ir.Node:
    """A function with some arguments given, as the lambda that it stands for."""
    last = ir.FunctionParameter(place, "(the rest)", "")  # no name in any program
    call = ir.Call(place, args[0], (*args[1:], ir.Name(place, last.name)), named=named)
    return ir.Function(place, "", (last,), (ir.Return(place, call),))


def _dictionary(lowering: Lowering, tree: ast.Dict) -> tuple[ir.Node, ...]:
    """A dictionary, as the call ``dict(keys, values)``."""
    place = lowering.place(tree)
    keys = tuple(lowering.one(key) for key in tree.keys if key is not None)
    values = tuple(lowering.one(value) for value in tree.values)
    if len(keys) < len(values):  # some come from another one
        return (ir.Opaque(place, (*keys, *values)),)
    both = (ir.Items(place, keys), ir.Items(place, values))
    return (ir.Call(place, ir.Name(place, "dict"), both),)


def _binary(lowering: Lowering, tree: ast.BinOp) -> tuple[ir.Node, ...]:
    sign = SIGNS.get(type(tree.op), "?")
    left, right = lowering.one(tree.left), lowering.one(tree.right)
    return (ir.Operation(lowering.place(tree), sign, left, right),)


def _unary(lowering: Lowering, tree: ast.UnaryOp) -> tuple[ir.Node, ...]:
    sign = SIGNS.get(type(tree.op), "?")
    return (ir.Operation(lowering.place(tree), sign, None, lowering.one(tree.operand)),)


def _choice(lowering: Lowering, tree: ast.IfExp) -> tuple[ir.Node, ...]:
    three = (lowering.one(part) for part in (tree.test, tree.body, tree.orelse))
    return (ir.Choice(lowering.place(tree), *three),)


def _items(lowering: Lowering, tree: ast.List | ast.Tuple) -> tuple[ir.Node, ...]:
    return (ir.Items(lowering.place(tree), lowering.many(tree.elts)),)


def _walrus(lowering: Lowering, tree: ast.NamedExpr) -> tuple[ir.Node, ...]:
    target, value = lowering.one(tree.target), lowering.one(tree.value)
    return (ir.Assign(lowering.place(tree), target, value),)


def _comprehension(
    lowering: Lowering, tree: ast.ListComp | ast.SetComp | ast.GeneratorExp
) -> tuple[ir.Node, ...]:
    place, first = lowering.place(tree), tree.generators[0]
    if len(tree.generators) > 1:
        return (ir.Opaque(place, lowering.many([tree.elt, *(g.iter for g in tree.generators)])),)
    body = (lowering.one(tree.elt),)
    return (ir.Loop(place, lowering.variables(first.target), lowering.one(first.iter), body),)


EXPRESSIONS: dict[type[ast.AST], Maker] = {
    ast.Constant: _constant,
    ast.Name: _name,
    ast.Attribute: _attribute,
    ast.Subscript: _subscript,
    ast.Call: _call,
    ast.BinOp: _binary,
    ast.UnaryOp: _unary,
    ast.IfExp: _choice,
    ast.List: _items,
    ast.Tuple: _items,
    ast.Dict: _dictionary,
    ast.NamedExpr: _walrus,
    ast.ListComp: _comprehension,
    ast.SetComp: _comprehension,
    ast.GeneratorExp: _comprehension,
}
