"""One Python file on its way from its ast to the common syntax."""

import ast
from collections.abc import Callable, Iterable
from itertools import accumulate

from grader.robotcode import ir

BRANCHES = (ast.If, ast.While, ast.Try, ast.Match)
SELF = frozenset({"self", "cls"})
SIGNS: dict[type[ast.AST], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.FloorDiv: "//",
    ast.Mod: "%",
    ast.USub: "-",
    ast.UAdd: "+",
}


class IrBuilder:
    """Builds the common syntax of one file, leaves first, so that no depth overflows the stack."""

    def __init__(self, source: bytes, makers: "dict[type[ast.AST], Maker]") -> None:
        self.source = source
        self.makers = makers
        lines = self.source.split(b"\n")
        self.begins = [0, *accumulate(len(line) + 1 for line in lines)]
        self.done: dict[int, tuple[ir.Node, ...]] = {}
        self.imports: list[ir.Import] = []

    def lower(self, root: ast.Module) -> tuple[ir.Node, ...]:
        """Lower a tree; an ast node may become no node, one or several."""
        order: list[ast.AST] = [root]
        for tree in order:
            order.extend(ast.iter_child_nodes(tree))
        for tree in reversed(order):
            self.done[id(tree)] = self._made(tree)
        return self.nodes_of(root.body)

    def _made(self, tree: ast.AST) -> tuple[ir.Node, ...]:
        make = self.makers.get(type(tree))
        if make is not None:
            return make(self, tree)
        parts = self.nodes_of(ast.iter_child_nodes(tree))
        if not isinstance(tree, ast.expr | ast.stmt):
            return parts
        if isinstance(tree, BRANCHES):
            return (ir.Branch(self.span_of(tree), parts),)
        return (ir.Opaque(self.span_of(tree), parts),)

    def span_of(self, tree: ast.expr | ast.stmt | ast.arg) -> ir.SourceSpan:
        """Where a tree stands in the file."""
        start = self.begins[tree.lineno - 1] + tree.col_offset
        end = self.begins[(tree.end_lineno or tree.lineno) - 1] + (tree.end_col_offset or 0)
        return ir.SourceSpan(self.source, start, end, tree.lineno)

    def nodes_of(self, trees: Iterable[ast.AST]) -> tuple[ir.Node, ...]:
        """The nodes of some trees."""
        return tuple(node for tree in trees for node in self.done[id(tree)])

    def node_of(self, tree: ast.expr | ast.stmt) -> ir.Node:
        """The node of one tree."""
        made = self.done[id(tree)]
        return made[0] if len(made) == 1 else ir.Opaque(self.span_of(tree), made)

    def source_text(self, tree: ast.expr | None) -> str:
        """The source text of a tree."""
        return "" if tree is None else self.span_of(tree).text

    def loop_variables(self, target: ast.expr) -> tuple[str, ...]:
        """The names that a loop fills; empty where it fills something else."""
        several = target.elts if isinstance(target, ast.List | ast.Tuple) else [target]
        return tuple(one.id if isinstance(one, ast.Name) else "" for one in several)


Maker = Callable[..., tuple[ir.Node, ...]]  # each takes the one kind of node it stands beside
