"""Resolve names to what they stand for: a value, a type, a method."""

import re

from grader.robotcode.ir import (
    Assign,
    Call,
    Cast,
    Class,
    Element,
    Function,
    FunctionParameter,
    Items,
    Loop,
    Member,
    Name,
    Node,
    Operation,
    Reference,
    Return,
    Text,
    iter_nodes,
)
from grader.robotcode.scope import Definitions, Scope, find_only_value, walk_with_scopes
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import STAND_INS, spell_as_java

MOST_STEPS = 20  # names followed, one to the next
MOST_PIECES = 5  # strings joined one into the other

Placed = tuple[Node, Scope]  # a node, and the scope it stands in
Method = tuple[Function, Scope]  # a function, and the scope inside it


def get_simple_type_name(type_: str) -> str:
    """A type's name without owner and arguments: ``Config``, ``List`` of ``List<TalonFX>``."""
    return re.sub(r"[<\[|].*", "", type_, flags=re.DOTALL).strip(" \"'").rpartition(".")[2]


def get_last_name(node: Node) -> str:
    """The last part of a dotted name, ``Config`` of ``SysIdRoutine.Config``; else empty."""
    return node.name if isinstance(node, Name | Member) else ""


def get_method_name(call: Call) -> str:
    """The name of the called method, in Java's spelling; empty if it has none."""
    return spell_as_java(get_last_name(call.target))


def resolve(node: Node, scope: Scope, names: SymbolTable) -> Placed:
    """Resolve constants, variables and plain getters to what they stand for.

    Returns:
        The node where the way ends, and its scope: a value, or the last name that has none or
        several.
    """
    for _ in range(MOST_STEPS):
        inner = node.value if isinstance(node, Cast | Assign) else None  # Python's walrus
        if inner is not None:
            node = inner
            continue
        if isinstance(node, Call):
            methods = find_called_functions(node, scope, names)
            returned = find_single_return(methods[0][0]) if len(methods) == 1 else None
            if returned is None:
                break
            node, scope = returned, methods[0][1]
            continue
        if isinstance(node, Reference):
            break
        found = find_only_value(names.find_definitions(node, scope))
        if found is None:
            break
        node, scope = found
        if isinstance(node, Function) and node.property:
            returned = find_single_return(node)
            if returned is None:
                break
            node, scope = returned, scope.within(node)
    return node, scope


def list_returned_nodes(function: Function) -> list[Node]:
    """The nodes that a function may return."""
    found = iter_nodes(*function.body, but=(Function, Class))
    return [node.value for node in found if isinstance(node, Return)]


def find_single_return(function: Function) -> Node | None:
    """The node that a function returns, if it has a single return."""
    found = list_returned_nodes(function)
    return found[0] if len(found) == 1 else None


def infer_type(node: Node, scope: Scope, names: SymbolTable) -> str:
    """The type of a variable, declared or seen from what it is made with; empty if unknown."""
    if isinstance(node, FunctionParameter):
        return node.type
    node = _without_settings(node)
    while isinstance(node, Element):  # of an array or a list: both types are taken for one
        node = node.owner
    made = _made(node, scope)
    return made if made is not None else infer_type_from(names.find_definitions(node, scope), names)


def infer_type_from(definitions: Definitions, names: SymbolTable) -> str:
    """The type that the definitions of one variable give it; empty if unknown."""
    for _ in range(MOST_STEPS):
        declared = next((d.type for d in definitions if d.type), "")
        first = next((d for d in definitions if d.value is not None), None)
        if declared or first is None or first.value is None:
            return declared
        value = _one_of(first.value)
        made = _made(value, first.scope)
        if made == "" and isinstance(value, Call):
            return _made_by_method(value, first.scope, names)
        if made is not None:
            return made
        definitions = names.find_definitions(_without_settings(value), first.scope)
    return ""


def _one_of(node: Node) -> Node:
    """Of a list, its first element; of an element, the list: their types are taken for one."""
    for _ in range(MOST_STEPS):
        if isinstance(node, Items) and node.items:
            node = node.items[0]
        elif isinstance(node, Loop) and node.body:  # a comprehension
            node = node.body[0]
        elif isinstance(node, Element):
            node = node.owner
    return node


def find_constructed_class(call: Call, scope: Scope, names: SymbolTable) -> str:
    """The original name of the class that a call constructs; empty if it constructs none."""
    target = call.target
    if isinstance(target, Name):
        brought = find_imported_name(target.name, scope)
        if brought:
            return brought
    target, _ = resolve(target, scope, names)  # Config = SysIdRoutine.Config
    made = get_last_name(target)
    return made if made[:1].isupper() else ""


def find_imported_name(name: str, scope: Scope) -> str:
    """The original name of an imported name; empty if it is not imported."""
    path = next((one.path for one in scope.module.imports if one.name == name), "")
    return path.rpartition(".")[2]


def _made(node: Node, scope: Scope) -> str | None:
    """The class that a constructor call makes; empty for another call, None for no call."""
    node = _without_settings(node)
    if not isinstance(node, Call):
        return None
    made = get_last_name(node.target)
    if isinstance(node.target, Name):
        made = find_imported_name(made, scope) or made
    return made if made[:1].isupper() else ""


def _made_by_method(call: Call, scope: Scope, names: SymbolTable) -> str:
    """The class that a method of these files makes; a call counts as none while it is looked at."""
    if call not in names.made:
        names.made[call] = ""
        with names.limit_depth() as allowed:
            if allowed:
                value, where = resolve(call, scope, names)
                made = (
                    find_constructed_class(value, where, names) if isinstance(value, Call) else ""
                )
                names.made[call] = made
    return names.made[call]


def _without_settings(node: Node) -> Node:
    """``new VoltageOut(0)`` of ``new VoltageOut(0).withEnableFOC(true)``."""
    while isinstance(node, Call) and isinstance(node.target, Member):
        if not node.target.name.startswith("with"):
            break
        node = node.target.owner
    return node


def find_class(node: Node, scope: Scope, names: SymbolTable) -> Scope | None:
    """The class that a node names or is an instance of, if these files hold it."""
    home = names.find_home(node, scope)
    if home is None:
        type_ = get_simple_type_name(infer_type(node, scope, names))
        home = names.find_by_name(type_, scope) if type_ else None
    return home


def fold_text(node: Node, scope: Scope, names: SymbolTable, *, depth: int = 0) -> str:
    """A string constant, joined from several where need be; empty if unknown."""
    node, scope = resolve(node, scope, names)
    if isinstance(node, Text):
        return node.value
    if isinstance(node, Operation) and node.sign == "+" and node.left and depth < MOST_PIECES:
        both = [fold_text(n, scope, names, depth=depth + 1) for n in (node.left, node.right)]
        return "".join(both) if all(both) else ""
    return ""


def find_called_functions(
    call: Call, scope: Scope, names: SymbolTable, *, owner: Placed | None = None
) -> list[Method]:
    """The functions of these files that a call may mean, by name and number of arguments.

    Args:
        call: the call.
        scope: where it stands.
        names: the names of the program.
        owner: what the method is called on, where a variable hides it.
    """
    target = call.target
    count = len(call.args) + len(call.named)
    if isinstance(target, Member):
        home = find_class(*(owner or (target.owner, scope)), names)
        return [] if home is None else _fitting(target.name, home, names, count)
    if not isinstance(target, Name):
        return []
    functions = [
        (d.value, d.scope.within(d.value))
        for d in names.find_definitions(target, scope)
        if isinstance(d.value, Function)
    ]
    if functions or scope.module.language == "python":
        return functions
    found = (_fitting(target.name, home, names, count) for home in scope.homes)
    return next(filter(None, found), [])


def find_methods(name: str, home: Scope, names: SymbolTable) -> list[Method]:
    """The methods of a name in a class, or in the classes above it if it has none."""
    places = names.list_base_classes(home) if home.classes else [home]
    return next(filter(None, (_methods_in(place, name, names) for place in places)), [])


def find_given_setting(node: Node, scope: Scope, names: SymbolTable) -> str:
    """The constant that the program gives a setting: ``Voltage`` of ``constants.DriveOutput``.

    A library's object holds it; what the program says is ``withDriveOutput(Type.Voltage)``.

    Returns:
        The constant's name; empty where there is no such call, or where two of them differ.
    """
    if not isinstance(node, Member) or scope.module.language != "java":
        return ""
    setter = f"with{node.name}"
    found = {
        get_last_name(resolve(inner.args[0], where, names)[0])
        for module in names.list_modules_with(setter)
        for inner, where in walk_with_scopes(module.body, Scope(module))
        if isinstance(inner, Call)
        and get_last_name(inner.target) == setter
        and len(inner.args) == 1
    }
    return found.pop() if len(found) == 1 else ""


def find_implementing_methods(method: Method, names: SymbolTable) -> list[Method]:
    """What classes of these files do in a method that a class or interface leaves empty.

    What only stands in for hardware, a simulation or the replay of a log, is not among them.
    """
    function, scope = method
    if function.body or not scope.classes or scope.module.language != "java":
        return []
    return [
        one
        for home in names.find_implementations(scope.home)
        if not STAND_INS.search(home.classes[-1].name)
        for one in _methods_in(home, function.name, names)
        if one[0].body and len(one[0].parameters) == len(function.parameters)
    ]


def _methods_in(home: Scope, name: str, names: SymbolTable) -> list[Method]:
    return [
        (node, home.within(node))
        for node in names.list_members(home)
        if isinstance(node, Function) and node.name == name
    ]


def _fitting(name: str, home: Scope, names: SymbolTable, count: int) -> list[Method]:
    found = find_methods(name, home, names)
    return [method for method in found if len(method[0].parameters) == count] or (
        found if len(found) == 1 and home.module.language == "python" else []
    )
