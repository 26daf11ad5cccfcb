"""Python's expressions in the common syntax, one small function each."""

import ast

from grader.robotcode import ir
from grader.robotcode.python.to_ir import SELF, SIGNS, IrBuilder, Maker


def _constant(lowering: IrBuilder, tree: ast.Constant) -> tuple[ir.Node, ...]:
    place, value = lowering.span_of(tree), tree.value
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


def _name(lowering: IrBuilder, tree: ast.Name) -> tuple[ir.Node, ...]:
    place = lowering.span_of(tree)
    return (ir.Self(place) if tree.id in SELF else ir.Name(place, tree.id),)


def _attribute(lowering: IrBuilder, tree: ast.Attribute) -> tuple[ir.Node, ...]:
    return (ir.Member(lowering.span_of(tree), lowering.node_of(tree.value), tree.attr),)


def _subscript(lowering: IrBuilder, tree: ast.Subscript) -> tuple[ir.Node, ...]:
    owner, index = lowering.node_of(tree.value), lowering.node_of(tree.slice)
    return (ir.Element(lowering.span_of(tree), owner, index),)


def _call(lowering: IrBuilder, tree: ast.Call) -> tuple[ir.Node, ...]:
    args = tuple(lowering.node_of(arg) for arg in tree.args if not isinstance(arg, ast.Starred))
    named = tuple((word.arg, lowering.node_of(word.value)) for word in tree.keywords if word.arg)
    spread = len(args) + len(named) < len(tree.args) + len(tree.keywords)
    target = lowering.node_of(tree.func)
    if isinstance(tree.func, ast.Name) and tree.func.id == "super":
        return (ir.Name(lowering.span_of(tree), "super"),)
    if args and not spread and lowering.source_text(tree.func) in {"partial", "functools.partial"}:
        return (_partial(lowering.span_of(tree), args, named),)
    if isinstance(target, ir.Member):  # a chain begins far above; its method stands here
        start = target.place.end - len(target.name.encode())
        line = tree.func.end_lineno or tree.lineno
        place = ir.SourceSpan(lowering.source, start, lowering.span_of(tree).end, line)
        target = ir.Member(place, target.owner, target.name)
    return (ir.Call(lowering.span_of(tree), target, args, named=named, spread=spread),)


def _partial(
    place: ir.SourceSpan, args: tuple[ir.Node, ...], named: tuple[tuple[str, ir.Node], ...]
) -> ir.Node:
    """A function with some arguments given, as the lambda that it stands for."""
    last = ir.FunctionParameter(place, "(the rest)", "")  # no name in any program
    call = ir.Call(place, args[0], (*args[1:], ir.Name(place, last.name)), named=named)
    return ir.Function(place, "", (last,), (ir.Return(place, call),))


def _dictionary(lowering: IrBuilder, tree: ast.Dict) -> tuple[ir.Node, ...]:
    """A dictionary, as the call ``dict(keys, values)``."""
    place = lowering.span_of(tree)
    keys = tuple(lowering.node_of(key) for key in tree.keys if key is not None)
    values = tuple(lowering.node_of(value) for value in tree.values)
    if len(keys) < len(values):  # some come from another one
        return (ir.Opaque(place, (*keys, *values)),)
    both = (ir.Items(place, keys), ir.Items(place, values))
    return (ir.Call(place, ir.Name(place, "dict"), both),)


def _binary(lowering: IrBuilder, tree: ast.BinOp) -> tuple[ir.Node, ...]:
    sign = SIGNS.get(type(tree.op), "?")
    left, right = lowering.node_of(tree.left), lowering.node_of(tree.right)
    return (ir.Operation(lowering.span_of(tree), sign, left, right),)


def _unary(lowering: IrBuilder, tree: ast.UnaryOp) -> tuple[ir.Node, ...]:
    sign = SIGNS.get(type(tree.op), "?")
    return (ir.Operation(lowering.span_of(tree), sign, None, lowering.node_of(tree.operand)),)


def _choice(lowering: IrBuilder, tree: ast.IfExp) -> tuple[ir.Node, ...]:
    three = (lowering.node_of(part) for part in (tree.test, tree.body, tree.orelse))
    return (ir.Choice(lowering.span_of(tree), *three),)


def _items(lowering: IrBuilder, tree: ast.List | ast.Tuple) -> tuple[ir.Node, ...]:
    return (ir.Items(lowering.span_of(tree), lowering.nodes_of(tree.elts)),)


def _walrus(lowering: IrBuilder, tree: ast.NamedExpr) -> tuple[ir.Node, ...]:
    target, value = lowering.node_of(tree.target), lowering.node_of(tree.value)
    return (ir.Assign(lowering.span_of(tree), target, value),)


def _comprehension(
    lowering: IrBuilder, tree: ast.ListComp | ast.SetComp | ast.GeneratorExp
) -> tuple[ir.Node, ...]:
    place, first = lowering.span_of(tree), tree.generators[0]
    if len(tree.generators) > 1:
        return (
            ir.Opaque(place, lowering.nodes_of([tree.elt, *(g.iter for g in tree.generators)])),
        )
    body = (lowering.node_of(tree.elt),)
    return (
        ir.Loop(place, lowering.loop_variables(first.target), lowering.node_of(first.iter), body),
    )


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
