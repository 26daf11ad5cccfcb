"""Python's statements in the common syntax, one small function each."""

import ast

from grader.robotcode import ir
from grader.robotcode.python.to_ir import SELF, SIGNS, IrBuilder, Maker

AROUND = frozenset({"Annotated", "Any", "ClassVar", "Final", "Optional"})  # around another type


def _assign(lowering: IrBuilder, tree: ast.Assign) -> tuple[ir.Node, ...]:
    place, value = lowering.span_of(tree), lowering.node_of(tree.value)
    made: list[ir.Node] = []
    for target in tree.targets:
        if not isinstance(target, ast.List | ast.Tuple):
            made.append(ir.Assign(place, lowering.node_of(target), value))
            continue
        several = value.items if isinstance(value, ir.Items) else ()
        fits = len(several) == len(target.elts)
        for index, part in enumerate(target.elts):
            got = several[index] if fits else ir.Opaque(place, (value,))
            made.append(ir.Assign(place, lowering.node_of(part), got))
    return tuple(made)


def _type(lowering: IrBuilder, annotation: ast.expr | None) -> str:
    """A type as written, without what is put around it: ``TalonFX`` of ``Final[TalonFX]``."""
    inner = annotation
    while isinstance(inner, ast.Subscript) and _ends(lowering, inner.value) in AROUND:
        several = inner.slice.elts if isinstance(inner.slice, ast.Tuple) else [inner.slice]
        inner = several[0] if several else None
    bare = inner is not None and _ends(lowering, inner) in AROUND
    return "" if bare else lowering.source_text(inner)


def _ends(lowering: IrBuilder, tree: ast.expr) -> str:
    return lowering.source_text(tree).rpartition(".")[2]


def _annotated(lowering: IrBuilder, tree: ast.AnnAssign) -> tuple[ir.Node, ...]:
    value = None if tree.value is None else lowering.node_of(tree.value)
    type_ = _type(lowering, tree.annotation)
    return (ir.Assign(lowering.span_of(tree), lowering.node_of(tree.target), value, type=type_),)


def _augmented(lowering: IrBuilder, tree: ast.AugAssign) -> tuple[ir.Node, ...]:
    place, target = lowering.span_of(tree), lowering.node_of(tree.target)
    sign = SIGNS.get(type(tree.op), "?")
    value = ir.Operation(place, sign, target, lowering.node_of(tree.value))
    return (ir.Assign(place, target, value),)


def _expression(lowering: IrBuilder, tree: ast.Expr) -> tuple[ir.Node, ...]:
    return lowering.done[id(tree.value)]


def _return(lowering: IrBuilder, tree: ast.Return) -> tuple[ir.Node, ...]:
    if tree.value is None:
        return ()
    return (ir.Return(lowering.span_of(tree), lowering.node_of(tree.value)),)


def _for(lowering: IrBuilder, tree: ast.For) -> tuple[ir.Node, ...]:
    body = lowering.nodes_of([*tree.body, *tree.orelse])
    variables = lowering.loop_variables(tree.target)
    return (ir.Loop(lowering.span_of(tree), variables, lowering.node_of(tree.iter), body),)


def _function(
    lowering: IrBuilder, tree: ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda
) -> tuple[ir.Node, ...]:
    place = lowering.span_of(tree)
    plain = [*tree.args.posonlyargs, *tree.args.args]
    given = [None] * (len(plain) - len(tree.args.defaults))
    defaults = [*given, *tree.args.defaults, *tree.args.kw_defaults]
    listed = zip([*plain, *tree.args.kwonlyargs], defaults, strict=True)
    parameters = tuple(
        ir.FunctionParameter(
            lowering.span_of(one),
            one.arg,
            _type(lowering, one.annotation),
            None if default is None else lowering.node_of(default),
        )
        for index, (one, default) in enumerate(listed)
        if index or one.arg not in SELF
    )
    if isinstance(tree, ast.Lambda):
        value = lowering.node_of(tree.body)
        return (ir.Function(place, "", parameters, (ir.Return(value.place, value),)),)
    property_ = any(lowering.source_text(word).endswith("property") for word in tree.decorator_list)
    body = lowering.nodes_of(tree.body)
    return (ir.Function(place, tree.name, parameters, body, property=property_),)


def _class(lowering: IrBuilder, tree: ast.ClassDef) -> tuple[ir.Node, ...]:
    bases = tuple(lowering.source_text(base).rpartition(".")[2] for base in tree.bases)
    return (ir.Class(lowering.span_of(tree), tree.name, bases, lowering.nodes_of(tree.body)),)


def _import(lowering: IrBuilder, tree: ast.Import) -> tuple[ir.Node, ...]:
    for alias in tree.names:
        if alias.asname:
            lowering.imports.append(ir.Import(alias.asname, alias.name))
        else:  # `import a.b` binds a, and makes a.b.c readable
            first = alias.name.partition(".")[0]
            lowering.imports.append(ir.Import(first, first))
    return ()


def _import_from(lowering: IrBuilder, tree: ast.ImportFrom) -> tuple[ir.Node, ...]:
    for alias in tree.names:
        path = tree.module or ""
        if alias.name != "*":
            path = f"{path}.{alias.name}".lstrip(".")
        name = alias.asname or alias.name
        lowering.imports.append(ir.Import(name, path, level=tree.level))
    return ()


STATEMENTS: dict[type[ast.AST], Maker] = {
    ast.Assign: _assign,
    ast.AnnAssign: _annotated,
    ast.AugAssign: _augmented,
    ast.Expr: _expression,
    ast.Return: _return,
    ast.For: _for,
    ast.FunctionDef: _function,
    ast.AsyncFunctionDef: _function,
    ast.Lambda: _function,
    ast.ClassDef: _class,
    ast.Import: _import,
    ast.ImportFrom: _import_from,
}
