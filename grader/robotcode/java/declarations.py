"""Java's declarations and statements in the common syntax, one small function each."""

import re

from tree_sitter import Node as Tree

from grader.robotcode import ir
from grader.robotcode.java.to_ir import IrBuilder, Maker


def _declaration(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    type_ = lowering.source_text(tree.child_by_field_name("type"))
    made = []
    for child in tree.children_by_field_name("declarator"):
        name = child.child_by_field_name("name")
        value = child.child_by_field_name("value")
        made.append(
            ir.Assign(
                lowering.span_of(child),
                ir.Name(lowering.span_of(name or child), lowering.source_text(name)),
                None if value is None else lowering.node_of(value, around=child),
                type="" if type_ == "var" else type_,
                declares=True,
            )
        )
    return tuple(made)


def _return(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    inside = lowering.nodes_of(tree.children)
    return (ir.Return(lowering.span_of(tree), inside[0]),) if len(inside) == 1 else inside


def _loop(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    body = tree.child_by_field_name("body")
    statements = () if body is None else lowering.done[body.id]
    variables = (lowering.source_text(tree.child_by_field_name("name")),)
    return (
        ir.Loop(lowering.span_of(tree), variables, lowering.child_node(tree, "value"), statements),
    )


def _parameters(lowering: IrBuilder, tree: Tree | None) -> tuple[tuple[str, str], ...]:
    """Name and type of each parameter of a method or lambda."""
    if tree is None:
        return ()
    if tree.type == "identifier":
        return ((lowering.source_text(tree), ""),)
    found = []
    for child in tree.named_children:
        name = child if child.type == "identifier" else child.child_by_field_name("name")
        if name is not None:
            found.append(
                (
                    lowering.source_text(name),
                    lowering.source_text(child.child_by_field_name("type")),
                )
            )
    return tuple(found)


def _function(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    place, body = lowering.span_of(tree), tree.child_by_field_name("body")
    listed = tree.child_by_field_name("parameters")
    parameters = tuple(
        ir.FunctionParameter(lowering.span_of(listed or tree), name, type_)
        for name, type_ in _parameters(lowering, listed)
    )
    name = lowering.source_text(tree.child_by_field_name("name"))
    if tree.type == "constructor_declaration":
        name = "<init>"
    if body is None:
        return (ir.Function(place, name, parameters, ()),)
    statements = lowering.nodes_of(body.children) if body.children else lowering.done[body.id]
    if tree.type == "lambda_expression" and body.type != "block":
        value = lowering.node_of(body, around=tree)
        statements = (ir.Return(value.place, value),)
    type_ = lowering.source_text(tree.child_by_field_name("type"))
    return (ir.Function(place, name, parameters, statements, type=type_),)


def _class(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    body = tree.child_by_field_name("body")
    members = () if body is None else lowering.nodes_of(body.children)
    bases = [
        re.sub(r"<.*", "", lowering.source_text(kind), flags=re.DOTALL).rpartition(".")[2]
        for child in tree.children
        if child.type in {"superclass", "super_interfaces", "extends_interfaces"}
        for group in child.named_children
        for kind in (group.named_children if group.type == "type_list" else [group])
    ]
    name = lowering.source_text(tree.child_by_field_name("name"))
    return (ir.Class(lowering.span_of(tree), name, tuple(bases), members),)


DECLARATIONS: dict[str, Maker] = {
    "field_declaration": _declaration,
    "constant_declaration": _declaration,
    "local_variable_declaration": _declaration,
    "return_statement": _return,
    "enhanced_for_statement": _loop,
    "lambda_expression": _function,
    "method_declaration": _function,
    "constructor_declaration": _function,
    "class_declaration": _class,
    "interface_declaration": _class,
    "enum_declaration": _class,
    "record_declaration": _class,
}
