"""Java's expressions in the common syntax, one small function each."""

from tree_sitter import Node as Tree

from grader.robotcode import ir
from grader.robotcode.java.to_ir import SKIPPED, IrBuilder, Maker


def _name(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    return (ir.Name(lowering.span_of(tree), lowering.source_text(tree)),)


def _self(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    return (ir.Self(lowering.span_of(tree)),)


def _null(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    return (ir.Null(lowering.span_of(tree)),)


def _number(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    place, digits = lowering.span_of(tree), lowering.source_text(tree).replace("_", "").lower()
    try:
        if tree.type == "decimal_floating_point_literal":
            return (ir.Number(place, float(digits.rstrip("fd")), integer=False),)
        base = 8 if tree.type == "octal_integer_literal" else 0
        return (ir.Number(place, float(int(digits.rstrip("l"), base)), integer=True),)
    except (ValueError, OverflowError):
        return (ir.Opaque(place),)


def _string(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    return (ir.Text(lowering.span_of(tree), lowering.source_text(tree).strip('"').strip()),)


def _member(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    field = tree.child_by_field_name("field")
    if field is not None and field.type == "this":  # Outer.this
        return _self(lowering, tree)
    owner = lowering.child_node(tree, "object")
    return (ir.Member(lowering.span_of(tree), owner, lowering.source_text(field)),)


def _reference(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    named = tree.named_children
    owner = lowering.node_of(named[0] if named else None, around=tree)
    name = lowering.source_text(named[-1]) if len(named) > 1 else "new"
    return (ir.Reference(lowering.span_of(tree), owner, name),)


def _scoped_type(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    named = tree.named_children
    if not named:
        return ()
    owner = lowering.node_of(named[0], around=tree)
    return (ir.Member(lowering.span_of(tree), owner, lowering.source_text(named[-1])),)


def _generic_type(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    return (lowering.node_of(tree.named_children[0] if tree.named_children else None, around=tree),)


def _method_call(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    name = tree.child_by_field_name("name") or tree
    owner = tree.child_by_field_name("object")
    start = lowering.span_of(name)
    place = ir.SourceSpan(lowering.source, name.start_byte, tree.end_byte, start.line)
    target: ir.Node = ir.Name(place, lowering.source_text(name))
    if owner is not None:  # a chain begins far above; its method stands where its name does
        target = ir.Member(place, lowering.node_of(owner, around=tree), lowering.source_text(name))
    return (ir.Call(lowering.span_of(tree), target, _arguments(lowering, tree)),)


def _creation(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    args = _arguments(lowering, tree)
    bodies = [child for child in tree.children if child.type == "class_body"]
    methods = [
        node
        for body in bodies
        for node in lowering.nodes_of(body.children)
        if isinstance(node, ir.Function)
    ]
    if len(methods) == 1 and not args:  # an anonymous Consumer is a lambda written long
        method = methods[0]
        return (ir.Function(method.place, "", method.parameters, method.body),)
    return (ir.Call(lowering.span_of(tree), lowering.child_node(tree, "type"), args),)


def _arguments(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    """The arguments one by one, so that a damaged one does not move the others."""
    arguments = tree.child_by_field_name("arguments")
    if arguments is None:
        return ()
    return tuple(
        lowering.node_of(child, around=arguments)
        for child in arguments.named_children
        if child.type not in SKIPPED
    )


def _operation(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    sign = lowering.source_text(tree.child_by_field_name("operator"))
    place = lowering.span_of(tree)
    if tree.type == "unary_expression":
        return (ir.Operation(place, sign, None, lowering.child_node(tree, "operand")),)
    left, right = lowering.child_node(tree, "left"), lowering.child_node(tree, "right")
    return (ir.Operation(place, sign, left, right),)


def _choice(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    three = (
        lowering.child_node(tree, name) for name in ("condition", "consequence", "alternative")
    )
    return (ir.Choice(lowering.span_of(tree), *three),)


def _cast(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    type_ = lowering.source_text(tree.child_by_field_name("type"))
    return (ir.Cast(lowering.span_of(tree), type_, lowering.child_node(tree, "value")),)


def _element(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    owner, index = lowering.child_node(tree, "array"), lowering.child_node(tree, "index")
    return (ir.Element(lowering.span_of(tree), owner, index),)


def _items(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    return (ir.Items(lowering.span_of(tree), lowering.nodes_of(tree.children)),)


def _array(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    value = tree.child_by_field_name("value")
    return lowering.done[value.id] if value is not None else (ir.Opaque(lowering.span_of(tree)),)


def _assignment(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    place, sign = lowering.span_of(tree), lowering.source_text(tree.child_by_field_name("operator"))
    target, value = lowering.child_node(tree, "left"), lowering.child_node(tree, "right")
    if sign != "=":
        value = ir.Operation(place, sign.removesuffix("="), _again(target), value)
    return (ir.Assign(place, target, value),)


def _update(lowering: IrBuilder, tree: Tree) -> tuple[ir.Node, ...]:
    place, inside = lowering.span_of(tree), lowering.nodes_of(tree.children)
    if len(inside) != 1:
        return inside
    return (ir.Assign(place, inside[0], ir.Opaque(place, ())),)


def _again(target: ir.Node) -> ir.Node:
    """A target as a value; only short ones: twice all that is in it, level by level, has no end."""
    owner = target.owner if isinstance(target, ir.Member) else target
    short = isinstance(owner, ir.Name | ir.Self)
    return target if short else ir.Opaque(target.place, ())


EXPRESSIONS: dict[str, Maker] = {
    "identifier": _name,
    "type_identifier": _name,
    "super": _name,
    "this": _self,
    "null_literal": _null,
    "decimal_integer_literal": _number,
    "hex_integer_literal": _number,
    "octal_integer_literal": _number,
    "binary_integer_literal": _number,
    "decimal_floating_point_literal": _number,
    "string_literal": _string,
    "field_access": _member,
    "method_reference": _reference,
    "scoped_type_identifier": _scoped_type,
    "generic_type": _generic_type,
    "method_invocation": _method_call,
    "object_creation_expression": _creation,
    "binary_expression": _operation,
    "unary_expression": _operation,
    "ternary_expression": _choice,
    "cast_expression": _cast,
    "array_access": _element,
    "array_initializer": _items,
    "array_creation_expression": _array,
    "assignment_expression": _assignment,
    "update_expression": _update,
}
