"""One Java file on its way from tree-sitter's tree to the common syntax."""

from collections.abc import Callable, Iterable

from tree_sitter import Node as Tree

from grader.robotcode import ir

BRANCHES = frozenset(
    {
        "if_statement",
        "while_statement",
        "do_statement",
        "for_statement",
        "try_statement",
        "try_with_resources_statement",
        "switch_expression",
    }
)
SKIPPED = frozenset(
    {"line_comment", "block_comment", "modifiers", "import_declaration", "package_declaration"}
)


class IrBuilder:
    """Builds the common syntax of one file, leaves first, so that no depth overflows the stack."""

    def __init__(self, source: bytes, makers: dict[str, "Maker"]) -> None:
        self.source = source
        self.makers = makers
        self.done: dict[int, tuple[ir.Node, ...]] = {}

    def lower(self, root: Tree) -> tuple[ir.Node, ...]:
        """Lower a tree; a tree-sitter node may become no node, one or several."""
        order = [root]
        for tree in order:
            order.extend(tree.children)
        for tree in reversed(order):
            self.done[tree.id] = self._made(tree)
        return self.nodes_of(root.children)

    def _made(self, tree: Tree) -> tuple[ir.Node, ...]:
        if not tree.is_named or tree.type in SKIPPED:
            return ()
        make = self.makers.get(tree.type)
        if make is not None:
            return make(self, tree)
        parts = self.nodes_of(tree.children)
        if tree.type in BRANCHES:
            return (ir.Branch(self.span_of(tree), parts),)
        return parts if len(parts) == 1 else (ir.Opaque(self.span_of(tree), parts),)

    def span_of(self, tree: Tree) -> ir.SourceSpan:
        """Where a tree stands in the file."""
        return ir.SourceSpan(self.source, tree.start_byte, tree.end_byte, tree.start_point[0] + 1)

    def source_text(self, tree: Tree | None) -> str:
        """The source text of a tree."""
        text = b"" if tree is None else self.source[tree.start_byte : tree.end_byte]
        return text.decode("utf-8", errors="replace")

    def nodes_of(self, trees: Iterable[Tree]) -> tuple[ir.Node, ...]:
        """The nodes of some trees."""
        return tuple(node for tree in trees for node in self.done[tree.id])

    def node_of(self, tree: Tree | None, *, around: Tree) -> ir.Node:
        """The node of a tree; a node without meaning where a mistake in the code left none."""
        made = () if tree is None else self.done[tree.id]
        return made[0] if len(made) == 1 else ir.Opaque(self.span_of(tree or around), made)

    def child_node(self, tree: Tree, name: str) -> ir.Node:
        """The node of one named child of a tree."""
        return self.node_of(tree.child_by_field_name(name), around=tree)


Maker = Callable[[IrBuilder, Tree], tuple[ir.Node, ...]]
