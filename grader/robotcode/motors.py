"""The motors of a class: which it owns, which follow another, and which a name stands for."""

from collections.abc import Iterator
from itertools import islice

from grader.robotcode.ir import (
    Assign,
    Call,
    Element,
    FunctionParameter,
    Items,
    Member,
    Name,
    Node,
    Opaque,
    Reference,
    Self,
    iter_nodes,
)
from grader.robotcode.name_resolution import (
    Placed,
    get_last_name,
    get_simple_type_name,
    infer_type,
    infer_type_from,
    resolve,
)
from grader.robotcode.scope import Scope, walk_with_scopes
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import (
    COLLECTIONS,
    DRIVES,
    FOLLOWERS,
    GROUPS,
    is_motor,
    normalize_enum_constant,
    spell_as_java,
)

DEEPEST = 3  # a list of groups of motors
MOST = 16  # motors in one list
MOST_NODES = 200  # of an expression that may make settings


def make_motor_label(node: Node) -> str:
    """The name of a motor in messages: ``m_left``, ``io.motor``."""
    if isinstance(node, Name):
        return node.name
    if isinstance(node, Member) and isinstance(node.owner, Self):
        return node.name
    return node.place.text


def list_group_members(node: Node, scope: Scope, names: SymbolTable) -> tuple[Placed, ...]:
    """The motors in an array, a list, a motor group or a drive, if they have names of their own."""
    found = _listed(node, scope, names)
    named = all(isinstance(item, Name | Member | Element | Items) for item, _ in found)
    return found[:MOST] if named else ()


def _listed(node: Node, scope: Scope, names: SymbolTable, *, depth: int = 0) -> tuple[Placed, ...]:
    """What is in an array, a list or a group, whatever it is."""
    value, where = resolve(node, scope, names)
    several: tuple[Node, ...] = ()
    if isinstance(value, Items):
        several = value.items
    elif isinstance(value, Call):
        maker = get_last_name(value.target)
        owner = get_last_name(value.target.owner) if isinstance(value.target, Member) else ""
        if maker in GROUPS | DRIVES or owner in COLLECTIONS:
            several = value.args
            if len(several) == 1 and depth < DEEPEST:  # Arrays.stream(m_modules)
                inner = _listed(several[0], where, names, depth=depth + 1)
                return inner or ((several[0], where),)
        elif where.module.language == "python" and depth < DEEPEST:
            return _paired(value, where, names, depth + 1)
    return tuple((item.owner if isinstance(item, Reference) else item, where) for item in several)


def _paired(call: Call, scope: Scope, names: SymbolTable, depth: int) -> tuple[Placed, ...]:
    """What Python's enumerate, zip and a dictionary's items and values run over."""
    name = get_last_name(call.target)
    lists: list[tuple[Placed, ...]] = []
    if isinstance(call.target, Name) and name in {"enumerate", "zip"}:
        lists = [_listed(arg, scope, names, depth=depth) for arg in call.args]
    elif isinstance(call.target, Member) and name in {"items", "values"}:
        table, scope = resolve(call.target.owner, scope, names)
        if isinstance(table, Call) and get_last_name(table.target) == "dict":
            lists = [_listed(arg, scope, names, depth=depth) for arg in table.args]
    if not lists or name == "values":
        return lists[-1] if lists else ()
    if name == "enumerate":
        lists = [tuple((Opaque(item.place, ()), where) for item, where in lists[0]), lists[0]]
    return tuple(
        (Items(group[-1][0].place, tuple(item for item, _ in group)), group[-1][1])
        for group in zip(*lists, strict=False)
        if len({where for _, where in group}) == 1
    )


def list_motor_names(
    node: Node, scope: Scope, names: SymbolTable, *, depth: int = 0
) -> tuple[str, ...]:
    """The motors that a node stands for: itself, or all that are in it."""
    if isinstance(node, Element):
        node = node.owner
    if depth < DEEPEST:
        members = list_group_members(node, scope, names) or _motor_behind(node, scope, names)
        if not members and isinstance(node, Name):
            members = tuple(
                (d.value, d.scope)
                for d in names.find_local(node.name, scope)
                if isinstance(d.value, Name | Member | Element)
            )
        if members:
            several = (list_motor_names(n, s, names, depth=depth + 1) for n, s in members[:MOST])
            return tuple(dict.fromkeys(name for some in several for name in some))
    return (make_motor_label(node),)


def _motor_behind(node: Node, scope: Scope, names: SymbolTable) -> tuple[Placed, ...]:
    """The motor whose part this is: ``m_motor`` of ``m_motor.getClosedLoopController()``."""
    value, where = resolve(node, scope, names)
    if isinstance(value, Call) and isinstance(value.target, Member):
        owner = value.target.owner
        if is_motor(infer_type(owner, where, names)):
            return ((owner, where),)
    return ()


def list_owned_motors(home: Scope, names: SymbolTable) -> tuple[str, ...]:
    """The motor controllers a class has, without those set to follow another."""
    classes = names.list_base_classes(home)
    found: dict[str, None] = {}
    for place in classes:
        for name, definitions in names.find_fields(place).items():
            first = next((d for d in definitions if d.value is not None), None)
            named = bool(
                first and first.value and list_group_members(first.value, first.scope, names)
            )
            type_ = infer_type_from(definitions, names)
            if (is_motor(type_) or get_simple_type_name(type_) in GROUPS) and not named:
                found[name] = None
    following = {name for place in classes for name in _Followers(names).of(place)}
    return tuple(name for name in found if name not in following)


class _Followers:
    """Finds the motors of a class that are set to follow another, in the order of the text."""

    def __init__(self, names: SymbolTable) -> None:
        self._names = names
        self._configs: set[tuple[str, Node | None]] = set()  # settings that make a follower

    def of(self, home: Scope) -> set[str]:
        """The names of the motors that follow."""
        found: set[str] = set()
        if b"ollow" not in home.module.source:  # follow, Follower, addFollower
            return found
        for node, scope in walk_with_scopes(home.classes[-1].body, home):
            if isinstance(node, Assign) and node.value and _follow_calls(node.value):
                self._configs.add(self._key(node.target, scope))
            elif isinstance(node, Call) and isinstance(node.target, Member):
                for motor, where in self._followers(node, node.target, scope):
                    found.update(self._called_with(motor, where, home))
        return found

    def _followers(self, call: Call, target: Member, scope: Scope) -> list[Placed]:
        """The motors that one call makes followers."""
        name = spell_as_java(target.name)
        motor = (target.owner, scope)
        first = call.args[0] if call.args else None
        if name == "addFollower":
            return [(arg, scope) for arg in call.args]
        if name == "follow":
            if is_motor(infer_type(target.owner, scope, self._names)):
                return [motor]
            self._configs.add(self._key(_root(target), scope))
        elif name == "setControl" and first is not None:
            return (
                [motor]
                if get_simple_type_name(infer_type(first, scope, self._names)) in FOLLOWERS
                else []
            )
        elif name == "set" and first is not None:
            return [motor] if normalize_enum_constant(get_last_name(first)) == "follower" else []
        elif name == "configure" and first is not None:
            follows = self._key(first, scope) in self._configs or self._settings_follow(
                first, scope
            )
            return [motor] if follows else []
        return []

    def _settings_follow(self, settings: Node, scope: Scope) -> bool:
        """Whether settings make a follower where they stand, or in the class they come from."""
        if _follow_calls(settings):
            return True
        home = (
            self._names.find_home(settings.owner, scope) if isinstance(settings, Member) else None
        )
        if home is None or not home.classes or home.classes == scope.classes:
            return False
        calls = [call for node in home.classes[-1].body for call in _follow_calls(node)]
        return get_last_name(settings) in {get_last_name(_root(call.target)) for call in calls}

    def _key(self, node: Node, scope: Scope) -> tuple[str, Node | None]:
        """A variable, told apart from those of the same name in other methods."""
        local = self._names.find_local(node.name, scope) if isinstance(node, Name) else ()
        return make_motor_label(node), local[0].scope.functions[-1] if local else None

    def _called_with(self, motor: Node, scope: Scope, home: Scope) -> Iterator[str]:
        """The motor's name; where it is a method's parameter, the motors it is called with."""
        local = self._names.find_local(motor.name, scope) if isinstance(motor, Name) else ()
        if not local or not isinstance(local[0].value, FunctionParameter):
            yield from list_motor_names(motor, scope, self._names)
            return
        function = local[0].scope.functions[-1]
        at = function.parameters.index(local[0].value)
        for node in iter_nodes(*home.classes[-1].body):
            if isinstance(node, Call) and get_last_name(node.target) == function.name:
                yield from (make_motor_label(arg) for arg in node.args[at : at + 1])


def _follow_calls(node: Node) -> list[Call]:
    nodes = islice(iter_nodes(node), MOST_NODES)
    return [n for n in nodes if isinstance(n, Call) and get_last_name(n.target) == "follow"]


def _root(node: Node) -> Node:
    """The variable a chain of calls begins with."""
    while isinstance(node, Member | Call):
        if isinstance(node, Member) and isinstance(node.owner, Self):
            return node
        node = node.owner if isinstance(node, Member) else node.target
    return node
