"""Analyze triggers: which buttons, modes of the robot and switches they depend on."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from grader.robotcode.button_vocabulary import (
    BOTH,
    BUTTONS,
    CONTROLLER,
    EITHER,
    MODES_OF,
    NOT,
    NUMBERED,
    OTHER_MODE,
    TEST_MODE,
    UNCHANGED,
    WRAPPERS,
    find_button_name,
)
from grader.robotcode.closure import (
    BoundNode,
    enter_call,
    find_bound_return,
    infer_bound_class,
    is_open_parameter,
    resolve_bound,
    resolve_call,
)
from grader.robotcode.constant_folding import ConstantFolder
from grader.robotcode.constant_truth import TruthFolder, find_operator, fold_literal
from grader.robotcode.ir import (
    Call,
    Choice,
    Function,
    FunctionParameter,
    Member,
    Name,
    Node,
    Opaque,
    Operation,
    Return,
)
from grader.robotcode.name_resolution import (
    get_last_name,
    get_method_name,
)
from grader.robotcode.symbol_table import SymbolTable
from grader.robotcode.vocabulary import spell_as_java

DEEPEST = 12  # triggers made of triggers
LONGEST_DEBOUNCE = 0.5  # [s] longer, and whoever holds the button waits in vain
COMPARING = {"==": True, "is": True, "!=": False, "is not": False, "^": False}
NOT_TEST = re.compile(
    r"not\((test|utility) mode.*\)"
)  # the key of a part that asks for any other mode
MATCH = re.compile(r"(is)?fmsattached", re.IGNORECASE)  # true in a match only


class TriggerKind(Enum):
    """What a part of a trigger depends on: a button, the robot's mode, a switch."""

    BUTTON = "button"
    TEST_MODE = "test mode"
    OTHER_MODE = "other mode"
    RELEASED = "released"  # a button that nobody presses keeps nobody from anything
    DELAYED = "delayed"  # true only after a time that is long, or cannot be told
    SWITCH = "switch"  # anything a person sets before the test
    NOTHING = "nothing"  # literally true
    ONCE = "asked once"  # test mode, asked while the program starts and kept in a variable
    UNKNOWN = "unknown"


WEAK = (  # what decides about parts of which not all have to hold, the weakest first
    TriggerKind.UNKNOWN,
    TriggerKind.DELAYED,
    TriggerKind.NOTHING,
    TriggerKind.BUTTON,
    TriggerKind.RELEASED,
    TriggerKind.OTHER_MODE,
)


@dataclass(frozen=True)
class TriggerPart:
    """One part of a trigger; all parts have to hold.

    Args:
        asks: what it looks at.
        key: the same text for the same thing.
        controller: whose button it is.
    """

    asks: TriggerKind
    key: str
    controller: str = ""


class Triggers:
    """Splits triggers and conditions into parts.

    Args:
        names: the names of the program.
        measures: its constants.
    """

    def __init__(self, names: SymbolTable, measures: ConstantFolder) -> None:
        self._names = names
        self._measures = measures
        self._truth = TruthFolder(names, measures)
        self.asked: set[Node] = set()  # calls that were looked at as part of some trigger

    def find_parts(self, seen: BoundNode, *, depth: int = 0) -> tuple[TriggerPart, ...]:
        """The parts of a trigger, or of a condition."""
        before = seen
        seen = resolve_bound(seen, self._names)
        node = seen.node
        if depth > DEEPEST or self._truth.fold(before):
            deep = TriggerPart(TriggerKind.UNKNOWN, "")
            return (deep if depth > DEEPEST else TriggerPart(TriggerKind.NOTHING, node.place.text),)
        if isinstance(node, Call):
            found = self._call(seen, node, depth + 1)
            kept = node is not before.node and isinstance(before.node, Name | Member)
            asked = get_last_name(node.target).lower().startswith("is")
            return tuple(map(_kept, found)) if kept and asked else found
        if isinstance(node, Function):
            return self._returned(replace(seen, scope=seen.scope.within(node)), node, depth + 1)
        if isinstance(node, Operation | Opaque):
            return self._operation(seen, node, depth + 1, named=node is not before.node)
        if isinstance(node, Choice):
            return self._choice(seen, node, depth + 1)
        return self._named(seen, node, depth + 1)

    def find_negated_parts(self, seen: BoundNode) -> tuple[TriggerPart, ...]:
        """The parts of a negated condition."""
        return (self._mixed(seen, [seen.node], "not", 1),)

    def find_controller(self, seen: BoundNode) -> str:
        """The controller that a node stands for: its port, or else its variable; empty if none."""
        node = seen.node
        if isinstance(node, Name) and node.name in seen.given:
            return self.find_controller(seen.given[node.name])
        if isinstance(node, Call) and get_method_name(node) == "getHID":
            return self.find_controller(seen.with_node(node.owner or node))
        if not isinstance(node, Name | Member) or not CONTROLLER.fullmatch(
            infer_bound_class(seen, self._names)
        ):
            return ""
        port = self.find_port(seen)
        return f"port {port}" if port is not None else node.name

    def find_port(self, seen: BoundNode) -> int | None:
        """The port a controller is made with; None if unknown."""
        made = resolve_bound(seen, self._names)
        if not isinstance(made.node, Call):
            return None
        args = [*made.node.args, *(node for word, node in made.node.named if word == "port")]
        found = self._measures.fold(args[0], made.scope) if args else None
        return None if found is None else int(found.value)

    def _returned(self, inside: BoundNode, node: Node, depth: int) -> tuple[TriggerPart, ...]:
        """What a supplier, or a called function, returns."""
        returned = find_bound_return(inside)
        if returned is not None:
            return self.find_parts(returned, depth=depth)
        return (TriggerPart(TriggerKind.SWITCH, node.place.text),)

    def _call(self, seen: BoundNode, call: Call, depth: int) -> tuple[TriggerPart, ...]:
        self.asked.add(call)
        name, args = get_method_name(call), call.all_args
        functions = resolve_call(seen, self._names)
        if len(functions) == 1:
            return self._returned(enter_call(seen, functions[0]), call, depth)
        if name in WRAPPERS and args:
            return self.find_parts(seen.with_node(args[-1]), depth=depth)
        if name in BUTTONS and args:
            rest = [self._argument(seen.with_node(arg)) for arg in args[1:]]
            return self._button(
                seen.with_node(args[0]), "button" if name[0] == "J" else "pov", rest
            )
        if isinstance(call.target, Name):  # a variable that holds a method: testing()
            held = resolve_bound(seen.with_node(call.target), self._names)
            if isinstance(held.node, Member):
                return self._named(held, held.node, depth)
        found = () if call.owner is None else self._method(seen, call.owner, name, args, depth)
        return found or self._named(seen, call.target, depth, text=call.place.text)

    def _method(
        self, seen: BoundNode, owner: Node, name: str, args: tuple[Node, ...], depth: int
    ) -> tuple[TriggerPart, ...]:
        """What a library's method of a trigger or a controller asks; nothing if it is neither."""
        if name in BOTH:
            return self._all_of(seen, (owner, *args), depth)
        if name in EITHER | NOT:
            return (self._mixed(seen, (owner, *args), name, depth),)
        if self.find_controller(seen.with_node(owner)):
            return self._on_controller(seen, owner, name, args, depth)
        if name == "debounce":
            return (
                *self.find_parts(seen.with_node(owner), depth=depth),
                *self._debounced(seen, args),
            )
        return self.find_parts(seen.with_node(owner), depth=depth) if name in UNCHANGED else ()

    def _debounced(self, seen: BoundNode, args: tuple[Node, ...]) -> tuple[TriggerPart, ...]:
        """A debounce that is longer than a person waits for."""
        found = self._measures.fold(args[0], seen.scope) if args else None
        if found is not None and found.value <= LONGEST_DEBOUNCE:
            return ()
        return (TriggerPart(TriggerKind.DELAYED, seen.node.place.text),)

    def _on_controller(
        self, seen: BoundNode, owner: Node, name: str, args: tuple[Node, ...], depth: int
    ) -> tuple[TriggerPart, ...]:
        """A button of a controller; one that is only polled in a loop of its own has a switch."""
        loops = [
            arg
            for arg in args
            if infer_bound_class(seen.with_node(arg), self._names) == "EventLoop"
        ]
        rest = [self._argument(seen.with_node(arg)) for arg in args if arg not in loops]
        switches = self._all_of(seen, loops, depth)
        return (*self._button(seen.with_node(owner), name, rest), *switches)

    def _button(self, owner: BoundNode, method: str, args: list[str]) -> tuple[TriggerPart, ...]:
        controller = self.find_controller(owner)
        word = find_button_name(method)
        if word in {"button", "raw"} and args:
            word = self._numbered(args[0], owner)
            args = []
        key = f"{controller} {word} {' '.join(args)}".strip()
        return (
            TriggerPart(
                TriggerKind.BUTTON if all([controller, *args]) else TriggerKind.UNKNOWN,
                key,
                controller,
            ),
        )

    def _numbered(self, text: str, owner: BoundNode) -> str:
        """A button given by its number, or by a name of the Button enum."""
        if (
            "xbox" in infer_bound_class(owner, self._names).lower()
            and text.isdigit()
            and int(text) < len(NUMBERED)
        ):
            return NUMBERED[int(text)]
        return text

    def _argument(self, seen: BoundNode) -> str:
        """A button's number, or its name; empty if unknown."""
        found = self._measures.fold(seen.node, seen.scope)
        seen = resolve_bound(seen, self._names)
        node = seen.node
        if found is None:
            found = self._measures.fold(node, seen.scope)
        if found is not None:
            return f"{found.value:g}"
        if isinstance(node, Member) and node.name == "value":
            node = node.owner
        if isinstance(node, Call) and isinstance(node.target, Name | Member):
            node = node.target
        if isinstance(node, Member):
            return find_button_name(node.name)
        return ""

    def _operation(
        self, seen: BoundNode, node: Operation | Opaque, depth: int, *, named: bool
    ) -> tuple[TriggerPart, ...]:
        inside = [part for part in node.parts if not isinstance(part, Return)]
        sign = find_operator(node)
        if not inside:
            always = node.place.text.lower() == "true" and not named
            asks = TriggerKind.NOTHING if always else TriggerKind.SWITCH
            return (TriggerPart(asks, node.place.text),)
        if len(inside) == 1:
            if isinstance(node, Opaque) and sign != "not":
                return self.find_parts(seen.with_node(inside[0]), depth=depth)
        elif sign == "and":
            return self._all_of(seen, inside, depth)
        elif sign in COMPARING:
            truths = [fold_literal(part) for part in inside]
            open_ = [part for part, truth in zip(inside, truths, strict=True) if truth is None]
            if len(open_) == 1:
                same = (truths[0] if truths[1] is None else truths[1]) is COMPARING[sign]
                return self._same_or_not(seen.with_node(open_[0]), depth, same=same)
        return (self._mixed(seen, inside, sign or node.place.text, depth),)

    def _all_of(
        self, seen: BoundNode, several: Iterable[Node], depth: int
    ) -> tuple[TriggerPart, ...]:
        """The parts of several conditions that must all hold."""
        return tuple(
            part for one in several for part in self.find_parts(seen.with_node(one), depth=depth)
        )

    def _choice(self, seen: BoundNode, node: Choice, depth: int) -> tuple[TriggerPart, ...]:
        """``condition ? true : false``; any other choice is a switch of the program's own."""
        one, other = fold_literal(node.one), fold_literal(node.other)
        if one is None or other is None or one is other:
            return (self._mixed(seen, [node.condition, node.one, node.other], "?", depth),)
        return self._same_or_not(seen.with_node(node.condition), depth, same=one)

    def _same_or_not(self, seen: BoundNode, depth: int, *, same: bool) -> tuple[TriggerPart, ...]:
        """A condition as it is, or turned round."""
        if same:
            return self.find_parts(seen, depth=depth)
        return (self._mixed(seen, [seen.node], "not", depth),)

    def _mixed(
        self, seen: BoundNode, several: Sequence[Node], sign: str, depth: int
    ) -> TriggerPart:
        """Parts of which not all have to hold, or not as they are: one, of the weakest kind."""
        found = self._all_of(seen, several, depth)
        turned = sign in {*NOT, "!", "~"}
        key = f"{'not' if turned else sign}({', '.join(sorted(part.key for part in found))})"
        if turned and len(found) == 1:
            if NOT_TEST.fullmatch(found[0].key):
                return TriggerPart(TriggerKind.TEST_MODE, found[0].key[4:-1])
            if MATCH.fullmatch(found[0].key):
                return TriggerPart(TriggerKind.SWITCH, key)
        controllers = {part.controller for part in found if part.controller}
        asks = _weakest({part.asks for part in found}, turned=turned)
        return TriggerPart(asks, key, min(controllers, default=""))

    def _named(
        self, seen: BoundNode, node: Node, depth: int, *, text: str = ""
    ) -> tuple[TriggerPart, ...]:
        """A method or a variable that has no one value."""
        call = None if text else self._as_call(seen, node)
        if call is not None:
            return self._call(seen.with_node(call), call, depth)
        word = spell_as_java(get_last_name(node))
        owner = get_last_name(node.owner) if isinstance(node, Member) else ""
        if owner in MODES_OF or word.lower().startswith("is"):
            if TEST_MODE.fullmatch(word):
                by = " of RobotModeTriggers" if owner == "RobotModeTriggers" else ""
                kind = "utility" if "utility" in word.lower() else "test"
                return (TriggerPart(TriggerKind.TEST_MODE, f"{kind} mode{by}"),)
            if OTHER_MODE.fullmatch(word):
                return (TriggerPart(TriggerKind.OTHER_MODE, word),)
        if isinstance(node, Name) and not text:
            return (self._variable(seen, node, depth),)
        unknown = isinstance(node, FunctionParameter)
        asks = TriggerKind.UNKNOWN if unknown else TriggerKind.SWITCH
        return (TriggerPart(asks, text or node.place.text),)

    def _as_call(self, seen: BoundNode, node: Node) -> Call | None:
        """A call of what is only named: a method, or a variable that holds a function."""
        call = Call(node.place, node, ())
        functions = resolve_call(seen.with_node(call), self._names)
        if isinstance(node, Member):
            self.asked.add(node)
            known = functions or self.find_controller(seen.with_node(node.owner))
            return call if known else None
        only = len(functions) == 1 and functions[0][0] not in seen.scope.functions
        return call if only and isinstance(node, Name) else None

    def _variable(self, seen: BoundNode, node: Name, depth: int) -> TriggerPart:
        """A variable: a parameter, or one that was given several values and may hold any."""
        if is_open_parameter(seen, self._names):
            return TriggerPart(TriggerKind.UNKNOWN, "")
        given = self._names.find_local(node.name, seen.scope)
        several = [one.value for one in given if one.value is not None]
        if len(several) > 1 and depth < DEEPEST:
            return self._mixed(seen, several, "or", depth + 1)
        return TriggerPart(TriggerKind.SWITCH, node.place.text)


def _weakest(kinds: set[TriggerKind], *, turned: bool) -> TriggerKind:
    """What several parts together depend on, where not all of them have to hold."""
    asks = next((kind for kind in WEAK if kind in kinds), TriggerKind.SWITCH)
    if turned and TriggerKind.TEST_MODE in kinds:
        return TriggerKind.OTHER_MODE
    if turned and asks is TriggerKind.BUTTON:
        return TriggerKind.RELEASED
    return TriggerKind.TEST_MODE if kinds == {TriggerKind.TEST_MODE} else asks


def _kept(part: TriggerPart) -> TriggerPart:
    """A part that a variable holds: test mode is then what it was when the program started."""
    return replace(part, asks=TriggerKind.ONCE) if part.asks is TriggerKind.TEST_MODE else part
