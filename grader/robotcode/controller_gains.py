"""Gains that a motor controller holds: Phoenix 6's Slot0Configs and REVLib's FeedForwardConfig.

Read are the calls and the fields of the vendors' documentation: ``withKV(…)``, ``slot0.kV = …``,
``config.Slot0.withKV(…)``, ``new FeedForwardConfig().kV(…)``, ``closedLoop.feedForward.sva(…)``,
and their spelling in RobotPy. Sources: CTRE's API of ``Slot0Configs`` (Phoenix 6 26.3), REV's of
``FeedForwardConfig`` (REVLib 2026).
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from grader.robotcode.ir import Assign, Call, Member, Node, Self
from grader.robotcode.name_resolution import (
    get_last_name,
    get_simple_type_name,
    infer_type,
    resolve,
)
from grader.robotcode.scope import Scope
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import normalize_enum_constant, spell_as_java

SLOT0, FEED_FORWARD = "Slot0Configs", "FeedForwardConfig"
SETTINGS = ("GravityType", "StaticFeedforwardSign")
RATIO = "SensorToMechanismRatio"  # of Phoenix 6's FeedbackConfigs: what a rotation is
FIELDS = {
    SLOT0: ("kS", "kV", "kA", "kG", "kP"),
    FEED_FORWARD: ("kS", "kV", "kA", "kG", "kCos", "kCosRatio"),
}
LETTERS = {"s": "kS", "v": "kV", "a": "kA", "g": "kG", "c": "kCos", "r": "kCosRatio"}
SEVERAL = ("sv", "sva", "svag", "svacr", "sg", "scr")  # FeedForwardConfig's methods for several
OTHER_SLOTS = {"slot1", "slot2", "slot3"}  # a last argument that is a ClosedLoopSlot
WITH = re.compile(r"with([A-Z]\w*)")


@dataclass(frozen=True)
class GainSetting:
    """One value that a motor controller's configuration is given.

    Args:
        kind: ``Slot0Configs`` or ``FeedForwardConfig``.
        name: ``kV``, ``kCos``, ``GravityType``, ``SensorToMechanismRatio``, …
        value: what it is given.
        scope: where that stands.
        line: its line, from 1.
        choice: of a setting, the constant without its season's dress: ``armcosine``.
    """

    kind: str
    name: str
    value: Node
    scope: Scope
    line: int
    choice: str = ""


def find_gain_settings(
    nodes: list[tuple[Node, Scope]], names: SymbolTable
) -> Iterator[GainSetting]:
    """Every gain, and every setting of a gain, that goes into a motor controller.

    Args:
        nodes: all nodes of a file with their scopes.
        names: the names of the program.
    """
    for node, scope in nodes:
        if isinstance(node, Call) and isinstance(node.target, Member):
            for kind, name, value in _called(node, node.target, scope, names):
                choice = _choice(name, value, scope, names)
                yield GainSetting(kind, name, value, scope, node.place.line, choice)
        elif isinstance(node, Assign) and isinstance(node.target, Member) and node.value:
            name = _field(node.target.name)
            if _is_ratio(node.target.name):
                yield GainSetting(SLOT0, RATIO, node.value, scope, node.place.line)
            elif name and _is_slot0(node.target.owner, scope, names):
                choice = _choice(name, node.value, scope, names)
                yield GainSetting(SLOT0, name, node.value, scope, node.place.line, choice)


def _choice(name: str, value: Node, scope: Scope, names: SymbolTable) -> str:
    """The constant that a setting is given; empty of a gain."""
    return (
        normalize_enum_constant(get_last_name(resolve(value, scope, names)[0]))
        if name in SETTINGS
        else ""
    )


def _called(
    call: Call, target: Member, scope: Scope, names: SymbolTable
) -> Iterator[tuple[str, str, Node]]:
    """What a call sets: kind, name, value."""
    name = spell_as_java(target.name)
    phoenix = WITH.fullmatch(name)
    if phoenix and len(call.args) == 1:
        field = _field(phoenix[1][:1].lower() + phoenix[1][1:])
        if _is_ratio(phoenix[1]):
            yield SLOT0, RATIO, call.args[0]
        if field and _is_slot0(target.owner, scope, names):
            yield SLOT0, field, call.args[0]
        return
    if not call.args or not _is_feed_forward(target.owner, scope, names):
        return
    if normalize_enum_constant(get_last_name(call.args[-1])) in OTHER_SLOTS:
        return
    if name in FIELDS[FEED_FORWARD]:
        yield FEED_FORWARD, name, call.args[0]
    elif name in SEVERAL:
        for letter, value in zip(name, call.args, strict=False):
            yield FEED_FORWARD, LETTERS[letter], value


def _field(name: str) -> str:
    """A field of Slot0Configs in Java's spelling; empty if it is none."""
    bare = spell_as_java(name).lower()
    return next((one for one in (*FIELDS[SLOT0], *SETTINGS) if one.lower() == bare), "")


def _is_ratio(name: str) -> bool:
    return _bare(name) == RATIO.lower()


def _is_slot0(node: Node, scope: Scope, names: SymbolTable) -> bool:
    """Whether something is the first slot of a configuration."""
    node = _chain_root(node)
    if isinstance(node, Self):
        return False
    made = get_simple_type_name(infer_type(node, scope, names))
    return made == SLOT0 or (not made and "slot0" in _bare(get_last_name(node)))


def _is_feed_forward(node: Node, scope: Scope, names: SymbolTable) -> bool:
    """Whether something is the feedforward of a Spark's configuration."""
    node = _chain_root(node)
    made = get_simple_type_name(infer_type(node, scope, names))
    return made == FEED_FORWARD or _bare(get_last_name(node)) == "feedforward"


def _bare(name: str) -> str:
    return name.replace("_", "").lower()


def _chain_root(node: Node) -> Node:
    """What a chain of settings begins with: ``new Slot0Configs()`` of ``….withKS(1).withKV(2)``."""
    while isinstance(node, Call) and isinstance(node.target, Member):
        name = spell_as_java(node.target.name)
        if not (WITH.fullmatch(name) or name in FIELDS[FEED_FORWARD] or name in SEVERAL):
            break
        node = node.target.owner
    return node
