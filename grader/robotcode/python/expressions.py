"""Python's expressions in the common syntax, one small function each."""

import ast

from grader.robotcode import syntax
from grader.robotcode.python.lowering import SELF, SIGNS, Lowering, Maker


def _constant(lowering: Lowering, tree: ast.Constant) -> tuple[syntax.Node, ...]:
    place, value = lowering.place(tree), tree.value
    if value is None:
        return (syntax.Null(place),)
    if isinstance(value, str):
        return (syntax.Text(place, value),)
    if isinstance(value, int | float) and not isinstance(value, bool):
        try:
            return (syntax.Number(place, float(value), integer=isinstance(value, int)),)
        except OverflowError:
            return (syntax.Opaque(place),)
    return (syntax.Opaque(place),)


def _name(lowering: Lowering, tree: ast.Name) -> tuple[syntax.Node, ...]:
    place = lowering.place(tree)
    return (syntax.Self(place) if tree.id in SELF else syntax.Name(place, tree.id),)


def _attribute(lowering: Lowering, tree: ast.Attribute) -> tuple[syntax.Node, ...]:
    return (syntax.Member(lowering.place(tree), lowering.one(tree.value), tree.attr),)


def _subscript(lowering: Lowering, tree: ast.Subscript) -> tuple[syntax.Node, ...]:
    owner, index = lowering.one(tree.value), lowering.one(tree.slice)
    return (syntax.Element(lowering.place(tree), owner, index),)


def _call(lowering: Lowering, tree: ast.Call) -> tuple[syntax.Node, ...]:
    args = tuple(lowering.one(arg) for arg in tree.args if not isinstance(arg, ast.Starred))
    named = tuple((word.arg, lowering.one(word.value)) for word in tree.keywords if word.arg)
    spread = len(args) + len(named) < len(tree.args) + len(tree.keywords)
    target = lowering.one(tree.func)
    if isinstance(tree.func, ast.Name) and tree.func.id == "super":
        return (syntax.Name(lowering.place(tree), "super"),)
    if args and not spread and lowering.said(tree.func) in {"partial", "functools.partial"}:
        return (_partial(lowering.place(tree), args, named),)
    if isinstance(target, syntax.Member):  # a chain begins far above; its method stands here
        start = target.place.end - len(target.name.encode())
        line = tree.func.end_lineno or tree.lineno
        place = syntax.Place(lowering.source, start, lowering.place(tree).end, line)
        target = syntax.Member(place, target.owner, target.name)
    return (syntax.Call(lowering.place(tree), target, args, named=named, spread=spread),)


def _partial(
    place: syntax.Place, args: tuple[syntax.Node, ...], named: tuple[tuple[str, syntax.Node], ...]
) -> syntax.Node:
    """A function with some arguments given, as the lambda that it stands for."""
    last = syntax.Parameter(place, "(the rest)", "")  # no name in any program
    call = syntax.Call(place, args[0], (*args[1:], syntax.Name(place, last.name)), named=named)
    return syntax.Function(place, "", (last,), (syntax.Return(place, call),))


def _dictionary(lowering: Lowering, tree: ast.Dict) -> tuple[syntax.Node, ...]:
    """A dictionary, as the call ``dict(keys, values)``."""
    place = lowering.place(tree)
    keys = tuple(lowering.one(key) for key in tree.keys if key is not None)
    values = tuple(lowering.one(value) for value in tree.values)
    if len(keys) < len(values):  # some come from another one
        return (syntax.Opaque(place, (*keys, *values)),)
    both = (syntax.Items(place, keys), syntax.Items(place, values))
    return (syntax.Call(place, syntax.Name(place, "dict"), both),)


def _binary(lowering: Lowering, tree: ast.BinOp) -> tuple[syntax.Node, ...]:
    sign = SIGNS.get(type(tree.op), "?")
    left, right = lowering.one(tree.left), lowering.one(tree.right)
    return (syntax.Operation(lowering.place(tree), sign, left, right),)


def _unary(lowering: Lowering, tree: ast.UnaryOp) -> tuple[syntax.Node, ...]:
    sign = SIGNS.get(type(tree.op), "?")
    return (syntax.Operation(lowering.place(tree), sign, None, lowering.one(tree.operand)),)


def _choice(lowering: Lowering, tree: ast.IfExp) -> tuple[syntax.Node, ...]:
    three = (lowering.one(part) for part in (tree.test, tree.body, tree.orelse))
    return (syntax.Choice(lowering.place(tree), *three),)


def _items(lowering: Lowering, tree: ast.List | ast.Tuple) -> tuple[syntax.Node, ...]:
    return (syntax.Items(lowering.place(tree), lowering.many(tree.elts)),)


def _walrus(lowering: Lowering, tree: ast.NamedExpr) -> tuple[syntax.Node, ...]:
    target, value = lowering.one(tree.target), lowering.one(tree.value)
    return (syntax.Assign(lowering.place(tree), target, value),)


def _comprehension(
    lowering: Lowering, tree: ast.ListComp | ast.SetComp | ast.GeneratorExp
) -> tuple[syntax.Node, ...]:
    place, first = lowering.place(tree), tree.generators[0]
    if len(tree.generators) > 1:
        return (
            syntax.Opaque(place, lowering.many([tree.elt, *(g.iter for g in tree.generators)])),
        )
    body = (lowering.one(tree.elt),)
    return (syntax.Loop(place, lowering.variables(first.target), lowering.one(first.iter), body),)


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
