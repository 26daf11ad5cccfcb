"""RobotPy text to the common syntax, with Python's own parser."""

import ast
import warnings
from collections.abc import Callable, Iterable
from itertools import accumulate
from pathlib import Path

from grader.robotcode import syntax
from grader.robotcode.facts import Problem

_SELF = frozenset({"self", "cls"})
_SIGNS: dict[type[ast.AST], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.FloorDiv: "//",
    ast.Mod: "%",
    ast.USub: "-",
    ast.UAdd: "+",
}
_BRANCHES = (ast.If, ast.While, ast.Try, ast.Match)


def parse(text: str, path: Path) -> syntax.Module:
    r"""Bring a Python file to the common syntax.

    Args:
        text: the source, with ``\n`` line ends.
        path: where it is.

    Returns:
        The module. A text that is not Python gives one without a body, and one problem.
    """
    source = text.encode("utf-8", errors="replace")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a doubtful escape is the learner's own affair
            tree = ast.parse(text)
    except SyntaxError as error:
        said = error.msg.partition(";")[0]
        problem = Problem(f"this is not Python: {said}", max(error.lineno or 1, 1))
    except (RecursionError, MemoryError, ValueError):
        problem = Problem("the code is nested deeper than Python itself can read", 1)
    else:
        lowering = _Lowering(source)
        body = lowering.lower(tree)
        return syntax.Module(path, "python", source, body, tuple(reversed(lowering.imports)))
    return syntax.Module(path, "python", source, (), problems=(problem,))


class _Lowering:
    """One file on its way to the common syntax; leaves first, so that no depth can hurt."""

    def __init__(self, source: bytes) -> None:
        self.source = source
        lines = self.source.split(b"\n")
        self.begins = [0, *accumulate(len(line) + 1 for line in lines)]
        self.done: dict[int, tuple[syntax.Node, ...]] = {}
        self.imports: list[syntax.Import] = []

    def lower(self, root: ast.Module) -> tuple[syntax.Node, ...]:
        """Lower a tree; an ast node may become no node, one or several."""
        order: list[ast.AST] = [root]
        for tree in order:
            order.extend(ast.iter_child_nodes(tree))
        for tree in reversed(order):
            self.done[id(tree)] = self._made(tree)
        return self.many(root.body)

    def _made(self, tree: ast.AST) -> tuple[syntax.Node, ...]:
        make = _MAKERS.get(type(tree))
        if make is not None:
            return make(self, tree)
        parts = self.many(ast.iter_child_nodes(tree))
        if not isinstance(tree, ast.expr | ast.stmt):
            return parts
        if isinstance(tree, _BRANCHES):
            return (syntax.Branch(self.place(tree), parts),)
        return (syntax.Opaque(self.place(tree), parts),)

    def place(self, tree: ast.expr | ast.stmt | ast.arg) -> syntax.Place:
        """Where a tree stands in the file."""
        start = self.begins[tree.lineno - 1] + tree.col_offset
        end = self.begins[(tree.end_lineno or tree.lineno) - 1] + (tree.end_col_offset or 0)
        return syntax.Place(self.source, start, end, tree.lineno)

    def many(self, trees: Iterable[ast.AST]) -> tuple[syntax.Node, ...]:
        """What some trees became."""
        return tuple(node for tree in trees for node in self.done[id(tree)])

    def one(self, tree: ast.expr | ast.stmt) -> syntax.Node:
        """What a tree became, as one node."""
        made = self.done[id(tree)]
        return made[0] if len(made) == 1 else syntax.Opaque(self.place(tree), made)

    def said(self, tree: ast.expr | None) -> str:
        """The source text of a tree."""
        return "" if tree is None else self.place(tree).text


def _constant(lowering: _Lowering, tree: ast.Constant) -> tuple[syntax.Node, ...]:
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


def _name(lowering: _Lowering, tree: ast.Name) -> tuple[syntax.Node, ...]:
    place = lowering.place(tree)
    return (syntax.Self(place) if tree.id in _SELF else syntax.Name(place, tree.id),)


def _attribute(lowering: _Lowering, tree: ast.Attribute) -> tuple[syntax.Node, ...]:
    return (syntax.Member(lowering.place(tree), lowering.one(tree.value), tree.attr),)


def _subscript(lowering: _Lowering, tree: ast.Subscript) -> tuple[syntax.Node, ...]:
    owner, index = lowering.one(tree.value), lowering.one(tree.slice)
    return (syntax.Element(lowering.place(tree), owner, index),)


def _call(lowering: _Lowering, tree: ast.Call) -> tuple[syntax.Node, ...]:
    args = tuple(lowering.one(arg) for arg in tree.args if not isinstance(arg, ast.Starred))
    named = tuple((word.arg, lowering.one(word.value)) for word in tree.keywords if word.arg)
    spread = len(args) + len(named) < len(tree.args) + len(tree.keywords)
    target = lowering.one(tree.func)
    if isinstance(target, syntax.Member):  # a chain begins far above; its method stands here
        start = target.place.end - len(target.name.encode())
        line = tree.func.end_lineno or tree.lineno
        place = syntax.Place(lowering.source, start, lowering.place(tree).end, line)
        target = syntax.Member(place, target.owner, target.name)
    return (syntax.Call(lowering.place(tree), target, args, named=named, spread=spread),)


def _binary(lowering: _Lowering, tree: ast.BinOp) -> tuple[syntax.Node, ...]:
    sign = _SIGNS.get(type(tree.op), "?")
    left, right = lowering.one(tree.left), lowering.one(tree.right)
    return (syntax.Operation(lowering.place(tree), sign, left, right),)


def _unary(lowering: _Lowering, tree: ast.UnaryOp) -> tuple[syntax.Node, ...]:
    sign = _SIGNS.get(type(tree.op), "?")
    return (syntax.Operation(lowering.place(tree), sign, None, lowering.one(tree.operand)),)


def _choice(lowering: _Lowering, tree: ast.IfExp) -> tuple[syntax.Node, ...]:
    three = (lowering.one(part) for part in (tree.test, tree.body, tree.orelse))
    return (syntax.Choice(lowering.place(tree), *three),)


def _items(lowering: _Lowering, tree: ast.List | ast.Tuple) -> tuple[syntax.Node, ...]:
    return (syntax.Items(lowering.place(tree), lowering.many(tree.elts)),)


def _assign(lowering: _Lowering, tree: ast.Assign) -> tuple[syntax.Node, ...]:
    place, value = lowering.place(tree), lowering.one(tree.value)
    made: list[syntax.Node] = []
    for target in tree.targets:
        if not isinstance(target, ast.List | ast.Tuple):
            made.append(syntax.Assign(place, lowering.one(target), value))
            continue
        several = value.items if isinstance(value, syntax.Items) else ()
        fits = len(several) == len(target.elts)
        for index, part in enumerate(target.elts):
            got = several[index] if fits else syntax.Opaque(place, (value,))
            made.append(syntax.Assign(place, lowering.one(part), got))
    return tuple(made)


def _annotated(lowering: _Lowering, tree: ast.AnnAssign) -> tuple[syntax.Node, ...]:
    value = None if tree.value is None else lowering.one(tree.value)
    type_ = lowering.said(tree.annotation)
    return (syntax.Assign(lowering.place(tree), lowering.one(tree.target), value, type=type_),)


def _augmented(lowering: _Lowering, tree: ast.AugAssign) -> tuple[syntax.Node, ...]:
    place, target = lowering.place(tree), lowering.one(tree.target)
    sign = _SIGNS.get(type(tree.op), "?")
    value = syntax.Operation(place, sign, target, lowering.one(tree.value))
    return (syntax.Assign(place, target, value),)


def _walrus(lowering: _Lowering, tree: ast.NamedExpr) -> tuple[syntax.Node, ...]:
    target, value = lowering.one(tree.target), lowering.one(tree.value)
    return (syntax.Assign(lowering.place(tree), target, value),)


def _expression(lowering: _Lowering, tree: ast.Expr) -> tuple[syntax.Node, ...]:
    return lowering.done[id(tree.value)]


def _return(lowering: _Lowering, tree: ast.Return) -> tuple[syntax.Node, ...]:
    if tree.value is None:
        return ()
    return (syntax.Return(lowering.place(tree), lowering.one(tree.value)),)


def _for(lowering: _Lowering, tree: ast.For) -> tuple[syntax.Node, ...]:
    body = lowering.many([*tree.body, *tree.orelse])
    variables = _variables(tree.target)
    return (syntax.Loop(lowering.place(tree), variables, lowering.one(tree.iter), body),)


def _variables(target: ast.expr) -> tuple[str, ...]:
    several = target.elts if isinstance(target, ast.List | ast.Tuple) else [target]
    return tuple(one.id if isinstance(one, ast.Name) else "" for one in several)


def _comprehension(
    lowering: _Lowering, tree: ast.ListComp | ast.SetComp | ast.GeneratorExp
) -> tuple[syntax.Node, ...]:
    place, first = lowering.place(tree), tree.generators[0]
    if len(tree.generators) > 1:
        return (
            syntax.Opaque(place, lowering.many([tree.elt, *(g.iter for g in tree.generators)])),
        )
    body = (lowering.one(tree.elt),)
    return (syntax.Loop(place, _variables(first.target), lowering.one(first.iter), body),)


def _function(
    lowering: _Lowering, tree: ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda
) -> tuple[syntax.Node, ...]:
    place = lowering.place(tree)
    listed = [*tree.args.posonlyargs, *tree.args.args, *tree.args.kwonlyargs]
    parameters = tuple(
        syntax.Parameter(lowering.place(one), one.arg, lowering.said(one.annotation))
        for index, one in enumerate(listed)
        if index or one.arg not in _SELF
    )
    if isinstance(tree, ast.Lambda):
        value = lowering.one(tree.body)
        return (syntax.Function(place, "", parameters, (syntax.Return(value.place, value),)),)
    property_ = any(lowering.said(word).endswith("property") for word in tree.decorator_list)
    body = lowering.many(tree.body)
    return (syntax.Function(place, tree.name, parameters, body, property=property_),)


def _class(lowering: _Lowering, tree: ast.ClassDef) -> tuple[syntax.Node, ...]:
    bases = tuple(lowering.said(base).rpartition(".")[2] for base in tree.bases)
    return (syntax.Class(lowering.place(tree), tree.name, bases, lowering.many(tree.body)),)


def _import(lowering: _Lowering, tree: ast.Import) -> tuple[syntax.Node, ...]:
    for alias in tree.names:
        if alias.asname:
            lowering.imports.append(syntax.Import(alias.asname, alias.name))
        else:  # `import a.b` binds a, and makes a.b.c readable
            first = alias.name.partition(".")[0]
            lowering.imports.append(syntax.Import(first, first))
    return ()


def _import_from(lowering: _Lowering, tree: ast.ImportFrom) -> tuple[syntax.Node, ...]:
    for alias in tree.names:
        path = tree.module or ""
        if alias.name != "*":
            path = f"{path}.{alias.name}".lstrip(".")
        name = alias.asname or alias.name
        lowering.imports.append(syntax.Import(name, path, level=tree.level))
    return ()


_Maker = Callable[..., tuple[syntax.Node, ...]]  # each takes the one kind of node it stands beside
_MAKERS: dict[type[ast.AST], _Maker] = {
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
    ast.Assign: _assign,
    ast.AnnAssign: _annotated,
    ast.AugAssign: _augmented,
    ast.NamedExpr: _walrus,
    ast.Expr: _expression,
    ast.Return: _return,
    ast.For: _for,
    ast.ListComp: _comprehension,
    ast.SetComp: _comprehension,
    ast.GeneratorExp: _comprehension,
    ast.FunctionDef: _function,
    ast.AsyncFunctionDef: _function,
    ast.Lambda: _function,
    ast.ClassDef: _class,
    ast.Import: _import,
    ast.ImportFrom: _import_from,
}
